#include "common/config/robot/urdf_tree.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "common/config/config.hpp"
#include "common/text/nearest_name.hpp"
#include "common/text/number_text.hpp"

namespace longreach {
namespace {

using tinyxml2::XMLElement;

std::string tag(const XMLElement& element) { return "<" + std::string(element.Name()) + ">"; }

std::string joined(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kShown); ++i) text += (i == 0 ? "" : ", ") + names[i];
  return names.size() > kShown ? text + ", ..." : text;
}

// Comments before the declaration are not XML, but other readers accept them. Lines keep their numbers.
std::string without_late_declaration(std::string text) {
  constexpr std::string_view kSpace = " \t\r\n";
  std::size_t at = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  for (;;) {
    at = text.find_first_not_of(kSpace, at);
    if (at == std::string::npos || !std::string_view(text).substr(at).starts_with("<!--")) break;
    const std::size_t end = text.find("-->", at);
    if (end == std::string::npos) return text;
    at = end + 3;
  }
  if (at == std::string::npos || !std::string_view(text).substr(at).starts_with("<?xml ")) return text;
  const std::size_t end = text.find("?>", at);
  if (end == std::string::npos) return text;
  for (std::size_t i = at; i < end + 2; ++i)
    if (text[i] != '\n') text[i] = ' ';
  return text;
}

}  // namespace

UrdfTree::UrdfTree(std::string name, const std::string& whole) : name_(std::move(name)) {
  const std::string text = without_late_declaration(whole);
  if (document_.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    if (document_.ErrorID() == tinyxml2::XML_ERROR_EMPTY_DOCUMENT)
      fail(1, "the file is empty; a URDF begins with <robot>");
    if (document_.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED)
      fail(document_.ErrorLineNum(), "elements are nested too deeply for a URDF");
    fail(document_.ErrorLineNum(),
         "this is not well-formed XML (" + std::string(document_.ErrorName()) + ")");
  }
  const XMLElement* robot = document_.RootElement();
  if (robot == nullptr || std::string_view(robot->Name()) != "robot")
    fail(robot == nullptr ? 1 : robot->GetLineNum(),
         (robot == nullptr ? std::string("the file has no root element") : "the root is " + tag(*robot)) +
             "; a URDF begins with <robot>");
  refuse_xacro(*robot);
  const char* called = robot->Attribute("name");
  robot_name_ = called == nullptr ? "" : called;
  read_links(*robot);
  read_edges(*robot);
}

void UrdfTree::fail(int line, const std::string& sentence) const {
  throw ConfigError(name_ + ":" + std::to_string(line) + ": " + sentence);
}

// Elements and expressions of the macro language, outside what is not looked at.
void UrdfTree::refuse_xacro(const XMLElement& element) const {
  const std::string expanded = name_.ends_with(".urdf") ? name_ : name_ + ".urdf";
  const auto refuse = [&](int line, const std::string& what) {
    fail(line, what +
                   " belongs to xacro; macros are not expanded here, so expand them first: xacro "
                   "FILE.xacro > " +
                   expanded);
  };
  for (const XMLElement* e = element.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    if (std::string_view(e->Name()).starts_with("xacro:")) refuse(e->GetLineNum(), tag(*e));
    for (const tinyxml2::XMLAttribute* a = e->FirstAttribute(); a != nullptr; a = a->Next()) {
      const std::string_view value = a->Value();
      if (value.find("${") != value.npos || value.find("$(") != value.npos)
        refuse(a->GetLineNum(), std::string(a->Name()) + "=\"" + std::string(value) + "\"");
    }
    if (std::string_view(e->Name()) == "joint" || std::string_view(e->Name()) == "link") refuse_xacro(*e);
  }
}

std::string UrdfTree::text_of(const XMLElement& element, const char* attribute) const {
  const char* text = element.Attribute(attribute);
  if (text == nullptr || *text == '\0')
    fail(element.GetLineNum(), tag(element) + " has no " + attribute + "; a URDF requires it");
  return text;
}

std::vector<double> UrdfTree::numbers_of(const XMLElement& element, const char* attribute,
                                         Infinity infinity) const {
  constexpr std::string_view kSpace = " \t\r\n";
  const char* whole = element.Attribute(attribute);
  std::string_view left = whole == nullptr ? "" : whole;
  std::vector<double> numbers;
  for (;;) {
    left.remove_prefix(std::min(left.find_first_not_of(kSpace), left.size()));
    if (left.empty()) return numbers;
    std::string_view word = left.substr(0, left.find_first_of(kSpace));
    left.remove_prefix(word.size());
    if (word.starts_with('+')) word.remove_prefix(1);
    double number = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size() ||
        !(std::isfinite(number) || (std::isinf(number) && infinity == Infinity::kAllowed)))
      fail(element.GetLineNum(), tag(element) + " has " + attribute + "=\"" + std::string(whole) + "\"; \"" +
                                     std::string(word) + "\" is not a finite number");
    numbers.push_back(number);
  }
}

double UrdfTree::number_of(const XMLElement& element, const char* attribute, double absent,
                           Infinity infinity) const {
  if (element.Attribute(attribute) == nullptr) return absent;
  const std::vector<double> numbers = numbers_of(element, attribute, infinity);
  if (numbers.size() != 1)
    fail(element.GetLineNum(), tag(element) + " has " + attribute + "=\"" + element.Attribute(attribute) +
                                   "\"; exactly one number is required");
  return numbers[0];
}

Vector3 UrdfTree::vector_of(const XMLElement& element, const char* attribute, const Vector3& absent) const {
  if (element.Attribute(attribute) == nullptr) return absent;
  const std::vector<double> numbers = numbers_of(element, attribute);
  if (numbers.size() != 3)
    fail(element.GetLineNum(), tag(element) + " has " + attribute + "=\"" + element.Attribute(attribute) +
                                   "\" with " + std::to_string(numbers.size()) +
                                   " numbers; three are required");
  return {numbers[0], numbers[1], numbers[2]};
}

void UrdfTree::read_links(const XMLElement& robot) {
  for (const XMLElement* e = robot.FirstChildElement("link"); e != nullptr;
       e = e->NextSiblingElement("link")) {
    const std::string name = text_of(*e, "name");
    const auto [had, added] = links_.emplace(name, e->GetLineNum());
    if (!added)
      fail(e->GetLineNum(),
           "link \"" + name + "\" is already defined on line " + std::to_string(had->second));
  }
  if (links_.empty()) fail(robot.GetLineNum(), "<robot> has no <link>");
}

std::string UrdfTree::link_of(const XMLElement& joint, const char* which) const {
  const XMLElement* e = joint.FirstChildElement(which);
  if (e == nullptr)
    fail(joint.GetLineNum(), "joint \"" + text_of(joint, "name") + "\" has no <" + which + "> link");
  const std::string link = text_of(*e, "link");
  if (!links_.contains(link))
    fail(e->GetLineNum(), "joint \"" + text_of(joint, "name") + "\" has the " + which + " link \"" + link +
                              "\", which is not in the file");
  return link;
}

void UrdfTree::read_edges(const XMLElement& robot) {
  std::map<std::string, int> names;
  for (const XMLElement* e = robot.FirstChildElement("joint"); e != nullptr;
       e = e->NextSiblingElement("joint")) {
    Edge edge{e, text_of(*e, "name"), link_of(*e, "parent"), link_of(*e, "child"), false};
    const auto [had, added] = names.emplace(edge.name, e->GetLineNum());
    if (!added)
      fail(e->GetLineNum(),
           "joint \"" + edge.name + "\" is already defined on line " + std::to_string(had->second));
    edge.moves = text_of(*e, "type") != "fixed";
    const auto [other, first] = edge_to_.emplace(edge.child, edge);
    if (!first)
      fail(e->GetLineNum(), "link \"" + edge.child + "\" is the child of two joints, \"" +
                                other->second.name + "\" and \"" + edge.name +
                                "\"; closed chains are not supported");
  }
}

std::string UrdfTree::root() const {
  std::vector<std::string> roots;
  for (const auto& [link, line] : links_) {
    if (!edge_to_.contains(link)) roots.push_back(link);
  }
  if (roots.size() == 1) return roots.front();
  if (roots.empty())
    fail(1, "every link is the child of a joint, so the tree has no root; closed chains are not supported");
  fail(1, "there are " + std::to_string(roots.size()) + " roots (" + joined(roots) +
              "); name the base of the arm in robot.base_link");
}

void UrdfTree::require_link(const char* field, const std::string& link) const {
  if (links_.contains(link)) return;
  Names names;
  for (const auto& [known, line] : links_) names.push_back(known);
  throw ConfigError(std::string(field) + " = \"" + link + "\": " + name_ + " has no such link" +
                    instead_of(link, names, "known"));
}

// Base to tip.
std::vector<const UrdfTree::Edge*> UrdfTree::chain(const std::string& base, const std::string& tip) const {
  std::vector<const Edge*> chain;
  std::string link = tip;
  while (link != base) {
    const auto above = edge_to_.find(link);
    if (above == edge_to_.end())
      fail(links_.at(tip),
           "link \"" + tip + "\" is not connected to \"" + base + "\": its chain begins at \"" + link + "\"");
    if (chain.size() > edge_to_.size())
      fail(above->second.element->GetLineNum(),
           "joint \"" + above->second.name + "\" is part of a closed chain; closed chains are not supported");
    chain.push_back(&above->second);
    link = above->second.parent;
  }
  std::ranges::reverse(chain);
  return chain;
}

std::string UrdfTree::only_end(const std::string& base, int moving) const {
  // Depth by depth, so that each link is looked at once.
  std::map<std::string, std::vector<const Edge*>> below;
  for (const auto& [child, edge] : edge_to_) below[edge.parent].push_back(&edge);
  std::vector<std::pair<std::string, int>> open{{base, 0}};
  std::vector<std::string> ends, behind;
  int most = 0;
  std::size_t looked = 0;
  while (!open.empty()) {
    if (++looked > links_.size())
      fail(1, "link \"" + base + "\" is part of a closed chain; closed chains are not supported");
    const auto [link, count] = open.back();
    open.pop_back();
    most = std::max(most, count);
    const auto next = below.find(link);
    if (count == moving) behind.push_back(link);
    if (count == moving && next == below.end()) ends.push_back(link);
    if (next == below.end() || count > moving) continue;
    for (const Edge* edge : next->second) open.emplace_back(edge->child, count + (edge->moves ? 1 : 0));
  }
  if (ends.size() == 1) return ends.front();
  std::ranges::sort(ends);
  std::ranges::sort(behind);
  const std::string six = std::to_string(moving) + " moving joints";
  if (ends.size() > 1)
    fail(1, std::to_string(ends.size()) + " end links have " + six + " before them (" + joined(ends) +
                "); name the tool in robot.tip_link");
  if (!behind.empty())
    fail(1, "no end link has " + six + " before it; name the tool in robot.tip_link: " + joined(behind) +
                (behind.size() == 1 ? " has " + six + " before it" : " have " + six + " before them"));
  fail(1, "no link has " + six + " between itself and \"" + base + "\"; the maximum is " +
              std::to_string(most) + ", and longreach needs an arm with " + std::to_string(moving));
}

UrdfTree::Arm UrdfTree::arm(const std::string& base_link, const std::string& tip_link, int moving) const {
  if (!base_link.empty()) require_link("robot.base_link", base_link);
  if (!tip_link.empty()) require_link("robot.tip_link", tip_link);
  Arm arm;
  arm.base_link = base_link.empty() ? root() : base_link;
  arm.tip_link = tip_link.empty() ? only_end(arm.base_link, moving) : tip_link;
  std::vector<std::string> movers;
  const std::vector<const Edge*> edges = chain(arm.base_link, arm.tip_link);
  for (const Edge* edge : edges) {
    if (edge->moves) movers.push_back(edge->name);
    arm.joints.push_back(joint_of(*edge));
  }
  if (static_cast<int>(movers.size()) != moving)
    fail(links_.at(arm.tip_link),
         "between \"" + arm.base_link + "\" and \"" + arm.tip_link + "\", " + std::to_string(movers.size()) +
             " joints are movable" + (movers.empty() ? "" : " (" + joined(movers) + ")") +
             "; longreach needs an arm with " + std::to_string(moving) +
             " movable joints: change robot.base_link or robot.tip_link, or make other joints fixed");
  arm.ignored = ignored(edges);
  return arm;
}

}  // namespace longreach
