#include "deploy/mujoco/mjcf_text.hpp"

#include <filesystem>
#include <stdexcept>

namespace longreach {
namespace {

constexpr int kDeepest = 20;  // of files that include files

[[noreturn]] void refuse(const std::string& file, const std::string& reason) {
  throw std::invalid_argument(file + ": " + reason);
}

void require_xml(const std::string& file, const tinyxml2::XMLDocument& document) {
  if (document.Error() || document.RootElement() == nullptr)
    refuse(file, std::string("is not XML: ") + (document.Error() ? document.ErrorStr() : "it is empty"));
}

/// Puts the contents of included files in the place of <include> below `parent`.
void include_files(tinyxml2::XMLElement& parent, const std::filesystem::path& folder, int depth) {
  for (auto* child = parent.FirstChildElement(); child != nullptr;) {
    auto* const next = child->NextSiblingElement();
    const char* const name = child->Attribute("file");
    if (std::string(child->Name()) != "include" || name == nullptr) {
      include_files(*child, folder, depth);
    } else {
      const std::string file = folder / name;
      if (depth == 0) refuse(file, "files include each other");
      tinyxml2::XMLDocument part;
      part.LoadFile(file.c_str());
      require_xml(file, part);
      include_files(*part.RootElement(), folder, depth - 1);
      tinyxml2::XMLNode* last = child;
      for (auto* node = part.RootElement()->FirstChild(); node != nullptr; node = node->NextSibling())
        last = parent.InsertAfterChild(last, node->DeepClone(parent.GetDocument()));
      parent.DeleteChild(child);
    }
    child = next;
  }
}

}  // namespace

void read_mjcf(const std::string& file, tinyxml2::XMLDocument& out) {
  out.LoadFile(file.c_str());
  require_xml(file, out);
  include_files(*out.RootElement(), std::filesystem::path(file).parent_path(), kDeepest);
}

void continue_keys(tinyxml2::XMLElement& root, const std::string& positions, const std::string& speeds) {
  const auto append = [](tinyxml2::XMLElement& key, const char* list, const std::string& more) {
    if (const char* present = key.Attribute(list))
      key.SetAttribute(list, (std::string(present) + " " + more).c_str());
  };
  for (auto* frames = root.FirstChildElement("keyframe"); frames != nullptr;
       frames = frames->NextSiblingElement("keyframe"))
    for (auto* key = frames->FirstChildElement("key"); key != nullptr; key = key->NextSiblingElement("key")) {
      append(*key, "qpos", positions);
      append(*key, "qvel", speeds);
    }
}

std::string text_of(const tinyxml2::XMLDocument& document) {
  tinyxml2::XMLPrinter text;
  document.Print(&text);
  return text.CStr();
}

}  // namespace longreach
