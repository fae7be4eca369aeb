// Writes the plain structs of a .proto file: one struct for each message, with the comments, types and defaults of its
// fields, one enum class for each enum, and visit_fields(), which names every field once for all templates over it
// (common/schema/). The output contains no protobuf, so that nodes and stages can use it.
//
//   structs DESCRIPTORS FILE.proto FILE.hpp
//
// DESCRIPTORS is what `protoc --include_imports --include_source_info --descriptor_set_out` writes.
//
//   double, bool, string, uint32, enum     member with the default of the schema
//   message                                struct; with (none_if_absent): std::optional
//   repeated double with (count) = 3       Vector3; (initial) gives the three numbers of its default
//   repeated double                        std::vector<double>
//   repeated message                       std::vector; with (count) = N: std::array
//   field with (unused)                    no member
//
// A message M becomes MConfig; the option (struct_name) or (enum_name) gives another name. Two messages may share a struct
// if their fields have the same names and types; they differ in their defaults.
//
// In a file with (state), the struct of a message M is M, and:
//
//   sfixed64 NAME_ns                       Time NAME
//   optional                               std::optional
//   (initial) = 1                          default of a number, flag or enum
//   (member) = "Buttons buttons.mode"      member `mode` of the struct Buttons, which is the member `buttons`
//   (type) = "Reason"                      this type
//   (shown)                                a member of visit_shown() instead of visit_fields(), because it is not recorded
//   message or enum with (by_hand)         its struct is in one of the headers (include)

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/stubs/strutil.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "proto/options.pb.h"

namespace {

using google::protobuf::Descriptor;
using google::protobuf::EnumDescriptor;
using google::protobuf::EnumValueDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::FileDescriptor;
namespace options = longreach::proto;

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  throw std::runtime_error(name + ": " + why);
}

bool is_state(const FileDescriptor& file) { return file.options().GetExtension(options::state); }

/// The comment before a descriptor as lines that start with `indent` and `slashes`; empty if there is none.
template <class D>
std::string comment_of(const D& d, const std::string& indent, const char* slashes = "///") {
  google::protobuf::SourceLocation place;
  if (!d.GetSourceLocation(&place)) return "";
  std::istringstream text(place.leading_comments);
  std::string out;
  for (std::string line; std::getline(text, line);) out += indent + slashes + line + "\n";
  return out;
}

template <class D>
std::string trailing_comment_of(const D& d) {
  google::protobuf::SourceLocation place;
  if (!d.GetSourceLocation(&place) || place.trailing_comments.empty()) return "";
  std::string text = place.trailing_comments;
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.find('\n') == std::string::npos ? "  //" + text : "";
}

/// "SPACE_MOUSE" becomes "kSpaceMouse".
std::string enumerator_of(const std::string& name) {
  std::string out = "k";
  bool begins = true;
  for (const char c : name) {
    if (c != '_') out += begins ? c : static_cast<char>(std::tolower(c));
    begins = c == '_';
  }
  return out;
}

std::string number(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  const std::string out(text, end);
  return out.find_first_of(".en") == std::string::npos ? out + ".0" : out;
}

std::string struct_name(const Descriptor& m) {
  if (m.options().HasExtension(options::struct_name)) return m.options().GetExtension(options::struct_name);
  return is_state(*m.file()) || m.name().ends_with("Config") ? m.name() : m.name() + "Config";
}

std::string enum_name(const EnumDescriptor& e) {
  return e.options().HasExtension(options::enum_name) ? e.options().GetExtension(options::enum_name)
                                                      : e.name();
}

/// A member of a struct of its own (option (member)).
struct Group {
  std::string type{}, name{}, member{};
};
Group group_of(const FieldDescriptor& f) {
  const std::string& text = f.options().GetExtension(options::member);
  const std::size_t space = text.find(' '), dot = text.find('.');
  if (space == std::string::npos) return {};
  if (dot == std::string::npos) refuse(f.full_name(), "(member) must be MEMBER or TYPE MEMBER.MEMBER");
  return {text.substr(0, space), text.substr(space + 1, dot - space - 1), text.substr(dot + 1)};
}

bool is_time(const FieldDescriptor& f) { return f.type() == FieldDescriptor::TYPE_SFIXED64; }

/// `operator` is a word of C++.
std::string member_name(const FieldDescriptor& f) {
  const Group group = group_of(f);
  if (!group.name.empty()) return group.name + "." + group.member;
  if (f.options().HasExtension(options::member)) return f.options().GetExtension(options::member);
  if (is_time(f) && f.name().ends_with("_ns")) return f.name().substr(0, f.name().size() - 3);
  return f.name() == "operator" ? "operator_" : f.name();
}

std::uint32_t count_of(const FieldDescriptor& f) { return f.options().GetExtension(options::count); }
bool is_vector3(const FieldDescriptor& f) {
  return f.is_repeated() && f.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE && count_of(f) == 3;
}
bool is_optional(const FieldDescriptor& f) {
  return f.options().GetExtension(options::none_if_absent) ||
         (is_state(*f.file()) && f.has_optional_keyword());
}
bool is_shown(const FieldDescriptor& f) { return f.options().GetExtension(options::shown); }
bool is_member(const FieldDescriptor& f) { return !f.options().GetExtension(options::unused); }

std::string scalar_type(const FieldDescriptor& f) {
  switch (f.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return "double";
    case FieldDescriptor::CPPTYPE_BOOL:
      return "bool";
    case FieldDescriptor::CPPTYPE_UINT32:
      return "std::uint32_t";
    case FieldDescriptor::CPPTYPE_UINT64:
      return "std::uint64_t";
    case FieldDescriptor::CPPTYPE_INT32:
      return "int";
    case FieldDescriptor::CPPTYPE_INT64:
      if (!is_time(f)) refuse(f.full_name(), "a field of this type has no member");
      return "Time";
    case FieldDescriptor::CPPTYPE_STRING:
      return "std::string";
    case FieldDescriptor::CPPTYPE_ENUM:
      return enum_name(*f.enum_type());
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return struct_name(*f.message_type());
    default:
      refuse(f.full_name(), "a field of this type has no member");
  }
}

std::string type_of(const FieldDescriptor& f) {
  if (f.options().HasExtension(options::type)) return f.options().GetExtension(options::type);
  if (is_vector3(f)) return "Vector3";
  const std::string type = scalar_type(f);
  const bool message = f.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE;
  if (!f.is_repeated()) return is_optional(f) ? "std::optional<" + type + ">" : type;
  if (message && count_of(f) > 0) return "std::array<" + type + ", " + std::to_string(count_of(f)) + ">";
  return "std::vector<" + type + ">";
}

std::string scalar_default(const FieldDescriptor& f) {
  const bool has_initial = f.options().ExtensionSize(options::initial) == 1;
  const double initial = has_initial ? f.options().GetExtension(options::initial, 0) : 0.0;
  switch (f.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return number(has_initial ? initial : f.default_value_double());
    case FieldDescriptor::CPPTYPE_BOOL:
      return initial != 0.0 || f.default_value_bool() ? "true" : "false";
    case FieldDescriptor::CPPTYPE_UINT32:
      return std::to_string(f.default_value_uint32());
    case FieldDescriptor::CPPTYPE_UINT64:
      return std::to_string(f.default_value_uint64());
    case FieldDescriptor::CPPTYPE_INT32:
      return std::to_string(f.default_value_int32());
    case FieldDescriptor::CPPTYPE_STRING:
      return f.default_value_string().empty()
                 ? ""
                 : '"' + google::protobuf::CEscape(f.default_value_string()) + '"';
    case FieldDescriptor::CPPTYPE_ENUM:
      return enum_name(*f.enum_type()) + "::" +
             enumerator_of((has_initial ? f.enum_type()->FindValueByNumber(static_cast<int>(initial))
                                        : f.default_value_enum())
                               ->name());
    default:
      return "";
  }
}

/// The message whose defaults a struct has: the first one of this name in the files.
using Structs = std::map<std::string, const Descriptor*>;

/// What differs from the defaults of the struct: `.a = 1.0, .b = 2.0`.
std::string differing(const Descriptor& m, const Descriptor& owner) {
  if (&m == &owner) return "";
  std::string out;
  if (m.field_count() != owner.field_count())
    refuse(m.full_name(), "has other fields than " + owner.full_name());
  for (int i = 0; i < m.field_count(); ++i) {
    const FieldDescriptor &mine = *m.field(i), &theirs = *owner.field(i);
    if (mine.name() != theirs.name() || type_of(mine) != type_of(theirs))
      refuse(mine.full_name(), "differs from " + theirs.full_name() + ", which shares its struct");
    if (scalar_default(mine) == scalar_default(theirs)) continue;
    out += (out.empty() ? "." : ", .") + member_name(mine) + " = " + scalar_default(mine);
  }
  return out;
}

std::string initializer_of(const FieldDescriptor& f, const Structs& structs) {
  if (is_vector3(f)) {
    const auto& initial = f.options();
    if (initial.ExtensionSize(options::initial) == 0) return " = Vector3::Zero()";
    if (initial.ExtensionSize(options::initial) != 3)
      refuse(f.full_name(), "(initial) must give three numbers");
    std::string numbers;
    for (int i = 0; i < 3; ++i)
      numbers += (i > 0 ? ", " : "") + number(initial.GetExtension(options::initial, i));
    return "{" + numbers + "}";
  }
  if (f.is_repeated() || is_optional(f) || f.options().HasExtension(options::type)) return "{}";
  const std::string type = type_of(f);
  if (type == "Vector3" || type == "JointVector") return " = " + type + "::Zero()";
  if (type == "Quaternion") return " = Quaternion::Identity()";
  if (f.message_type() && f.message_type()->options().GetExtension(options::by_hand)) return "{}";
  if (f.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE)
    return "{" + differing(*f.message_type(), *structs.at(struct_name(*f.message_type()))) + "}";
  const std::string value = scalar_default(f);
  return value.empty() ? "{}" : " = " + value;
}

void write_enum(const EnumDescriptor& e, std::ostream& out) {
  if (e.options().GetExtension(options::enum_by_hand)) return;
  int count = 0;
  out << comment_of(e, "") << "enum class " << enum_name(e) << " : std::uint8_t {\n";
  for (int i = 0; i < e.value_count(); ++i) {
    const EnumValueDescriptor& value = *e.value(i);
    out << comment_of(value, "  ", "//") << "  " << enumerator_of(value.name()) << " = " << value.number()
        << "," << trailing_comment_of(value) << "\n";
    count = std::max(count, value.number() + 1);
  }
  out << "};\ntemplate <>\ninline constexpr int kCountOf<" << enum_name(e) << "> = " << count << ";\n\n";
}

/// Members and visits of a struct.
struct Parts {
  std::ostringstream members{}, visits{};
};

class Writer {
 public:
  Writer(const FileDescriptor& file, Structs structs) : file_(file), structs_(std::move(structs)) {}

  void write(std::ostream& out) {
    std::ostringstream body;
    for (int i = 0; i < file_.enum_type_count(); ++i) write_enum(*file_.enum_type(i), body);
    std::set<const Descriptor*> unused;
    for (int i = 0; i < file_.message_type_count(); ++i)
      for (int j = 0; j < file_.message_type(i)->field_count(); ++j)
        if (!is_member(*file_.message_type(i)->field(j)))
          unused.insert(file_.message_type(i)->field(j)->message_type());
    for (int i = 0; i < file_.message_type_count(); ++i)
      if (!unused.contains(file_.message_type(i))) write_struct(*file_.message_type(i), body);
    out << "#pragma once\n// Written from " << file_.name()
        << " by proto/structs.cpp. Change the schema, not this file.\n\n";
    for (const char* name : {"array", "cstdint", "optional", "string", "vector"})
      out << "#include <" << name << ">\n";
    out << "\n#include \"common/schema/visit.hpp\"\n#include \"common/spatial/spatial.hpp\"\n";
    for (const std::string& name : file_.options().GetRepeatedExtension(options::include))
      out << "#include \"" << name << "\"\n";
    for (int i = 0; i < file_.dependency_count(); ++i)
      if (file_.dependency(i)->name() != "proto/options.proto")
        out << "#include \"" << header_of(*file_.dependency(i)) << "\"\n";
    out << "\nnamespace longreach {\n\n" << body.str() << "}  // namespace longreach\n";
  }

 private:
  static std::string header_of(const FileDescriptor& file) {
    std::string name = file.name();
    return "schema/" + name.substr(6, name.rfind('.') - 6) + ".hpp";
  }

  /// Writes the struct of `m` after those of its members.
  void write_struct(const Descriptor& m, std::ostream& out) {
    const std::string name = struct_name(m);
    if (m.file() != &file_ || structs_.at(name) != &m || m.options().GetExtension(options::by_hand)) return;
    if (!written_.insert(name).second) return;
    for (int i = 0; i < m.field_count(); ++i)
      if (is_member(*m.field(i)) && m.field(i)->message_type())
        write_struct(*m.field(i)->message_type(), out);
    for (int i = 0; i < m.enum_type_count(); ++i) write_enum(*m.enum_type(i), out);
    std::ostringstream members, visits, shown;
    std::map<std::string, Parts> groups;
    for (int i = 0; i < m.field_count(); ++i) {
      const FieldDescriptor& f = *m.field(i);
      if (!is_member(f)) continue;
      const Group group = group_of(f);
      if (!group.type.empty() && !groups.contains(group.type))
        members << "  " << group.type << " " << group.name << "{};\n";
      (group.type.empty() ? members : groups[group.type].members)
          << comment_of(f, "  ") << "  " << type_of(f) << " "
          << (group.type.empty() ? member_name(f) : group.member) << initializer_of(f, structs_) << ";"
          << trailing_comment_of(f) << "\n";
      (is_shown(f) ? shown : visits) << visit(f.name(), member_name(f));
      if (!group.type.empty()) groups[group.type].visits << visit(group.member, group.member);
    }
    for (const auto& [type, parts] : groups) {
      out << "struct " << type << " {\n" << parts.members.str() << "};\n\n";
      write_visit("visit_fields", type, parts.visits.str(), out);
    }
    out << comment_of(m, "") << "struct " << name << " {\n" << members.str();
    if (!is_state(file_)) out << "\n  bool operator==(const " << name << "&) const = default;\n";
    out << "};\n\n";
    write_visit("visit_fields", name, visits.str(), out);
    if (!shown.str().empty()) write_visit("visit_shown", name, shown.str(), out);
  }

  static std::string visit(const std::string& name, const std::string& member) {
    return "  visit(\"" + name + "\", s." + member + ");\n";
  }
  static void write_visit(const char* function, const std::string& type, const std::string& visits,
                          std::ostream& out) {
    out << "template <class Visitor, Is<" << type << "> S>\nvoid " << function << "(Visitor& visit, S& s) {\n"
        << visits << "}\n\n";
  }

  const FileDescriptor& file_;
  Structs structs_;
  std::set<std::string> written_;
};

/// Adds the structs of `file` and of what it imports.
void collect(const FileDescriptor& file, Structs& structs) {
  for (int i = 0; i < file.dependency_count(); ++i) collect(*file.dependency(i), structs);
  for (int i = 0; i < file.message_type_count(); ++i)
    structs.emplace(struct_name(*file.message_type(i)), file.message_type(i));
}

void run(const std::string& descriptors, const std::string& name, const std::string& header) {
  google::protobuf::FileDescriptorSet set;
  std::ifstream input(descriptors, std::ios::binary);
  if (!input || !set.ParseFromIstream(&input)) refuse(descriptors, "is not a set of descriptors");
  google::protobuf::DescriptorPool pool;
  for (const auto& file : set.file())
    if (!pool.BuildFile(file)) refuse(file.name(), "cannot be used");
  const FileDescriptor* file = pool.FindFileByName(name);
  if (!file) refuse(name, "is not among the descriptors");
  Structs structs;
  collect(*file, structs);
  std::ostringstream text, before;
  Writer(*file, std::move(structs)).write(text);
  before << std::ifstream(header).rdbuf();
  if (before.str() == text.str()) return;  // nothing that includes it must be compiled again
  std::ofstream out(header);
  if (!(out << text.str()).flush()) refuse(header, "cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: structs DESCRIPTORS FILE.proto FILE.hpp\n";
    return 2;
  }
  try {
    run(argv[1], argv[2], argv[3]);
    return 0;
  } catch (const std::exception& problem) {
    std::cerr << "structs: " << problem.what() << "\n";
    return 1;
  }
}
