#pragma once
// While an instance exists, protobuf does not print to standard error, because the caller reports damaged
// files itself. Use it only in programs that read files in a single thread.

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
