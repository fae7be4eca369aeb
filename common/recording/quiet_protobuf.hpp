#pragma once
// While one exists, protobuf prints nothing to standard error: what it finds in a damaged file is said in the
// error of the caller. For programs that read files, in one thread.

#include <google/protobuf/stubs/logging.h>

namespace longreach {

class QuietProtobuf {
 public:
  QuietProtobuf() : before_(google::protobuf::SetLogHandler(nullptr)) {}
  ~QuietProtobuf() { google::protobuf::SetLogHandler(before_); }
  QuietProtobuf(const QuietProtobuf&) = delete;
  QuietProtobuf& operator=(const QuietProtobuf&) = delete;

 private:
  google::protobuf::LogHandler* before_;
};

}  // namespace longreach
