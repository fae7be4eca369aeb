#pragma once
// Error while writing or reading a recording: one sentence that names the file and the reason.

#include <stdexcept>

namespace longreach {

class RecordingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace longreach
