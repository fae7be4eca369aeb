#pragma once
// Resource usage of a running program, read from /proc. Counting its descriptors requires that the program
// was started with --core-dumps or that the test runs as root.

#include <sys/types.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace longreach {

inline double resident_mb(pid_t program) {
  long pages = 0, resident = 0;
  std::ifstream("/proc/" + std::to_string(program) + "/statm") >> pages >> resident;
  return static_cast<double>(resident) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1e6;
}

inline int descriptors(pid_t program) {
  const std::filesystem::directory_iterator all("/proc/" + std::to_string(program) + "/fd");
  return static_cast<int>(std::distance(begin(all), end(all)));
}

}  // namespace longreach
