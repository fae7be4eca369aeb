#pragma once
// A recording that cannot be written or read: one sentence that names the file and says why.

#include <stdexcept>

namespace longreach {

class RecordingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace longreach
