// What may not change now.

#include "common/config/config.hpp"
#include "common/config/differences.hpp"

namespace longreach {

std::vector<std::string> refused_changes(const google::protobuf::Message& before,
                                         const google::protobuf::Message& after, bool engaged) {
  std::vector<std::string> refused;
  for (const auto& [path, change] : differences(before, after)) {
    if (change == proto::AT_START || (engaged && change == proto::NOT_WHILE_ENGAGED))
      refused.push_back(path_text(before, path));
  }
  return refused;
}

}  // namespace longreach
