// The manual page: roff of the macros that every man knows.

#include <algorithm>
#include <cctype>

#include "common/program/command_words.hpp"
#include "common/program/program_text.hpp"

namespace longreach {
namespace {

/// As it stands, whatever roff would make of it.
std::string escaped(const std::string& text) {
  std::string out;
  bool begins = true;
  for (const char c : text) {
    if (begins && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
    begins = c == '\n';
  }
  return out;
}

/// Paragraphs at empty lines; indented lines as they are.
std::string paragraphs(const std::string& text) {
  std::string out;
  bool verbatim = false;
  std::size_t at = 0;
  while (at <= text.size() && !text.empty()) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    at = end + 1;
    const bool indented = line.starts_with("  ");
    if (indented != verbatim) out += indented ? ".nf\n" : ".fi\n";
    verbatim = indented;
    // Breaks where the author broke the line.
    if (!indented && !out.empty() && !line.empty() && !out.ends_with(".PP\n")) out += ".br\n";
    out += line.empty() ? ".PP\n" : escaped(line) + "\n";
    if (end == text.size()) break;
  }
  return out + (verbatim ? ".fi\n" : "");
}

std::string entry(const OptionWords& option) {
  std::string head = option.names.empty() ? "" : "\\fB" + escaped(joined(option.names, ", ")) + "\\fR";
  if (!option.what.empty()) head += (head.empty() ? "" : " ") + ("\\fI" + escaped(option.what) + "\\fR");
  std::string help = escaped(option.help);
  if (!option.choices.empty())
    help += (help.empty() ? "" : "; ") + escaped("one of " + joined(option.choices, ", "));
  return ".TP\n" + head + "\n" + (help.empty() ? "\\&" : help) + "\n";
}

std::string usage(const CommandWords& command) {
  std::string out = command.options.empty() ? "" : " [OPTIONS]";
  for (const OptionWords& positional : command.positionals) out += " " + positional.what;
  if (!command.commands.empty()) out += " COMMAND";
  return out;
}

}  // namespace

std::string manual_page(const CLI::App& app, const std::string& title) {
  const std::vector<CommandWords> all = command_words(app);
  const std::string program = app.get_name();
  std::string upper = program;
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  const std::string& about = all.front().help;
  std::string out = ".\\\" Made by " + program + " --man.\n.TH " + escaped(upper) + " 1 \"\" \"" +
                    escaped(title) + "\" longreach\n.SH NAME\n" + escaped(program) + " \\- " +
                    escaped(about.substr(0, about.find_first_of(":.\n"))) + "\n.SH SYNOPSIS\n\\fB" +
                    escaped(program) + "\\fR" + escaped(usage(all.front())) + "\n.SH DESCRIPTION\n" +
                    paragraphs(about);
  out += ".SH OPTIONS\n";
  for (const OptionWords& option : all.front().options) out += entry(option);
  if (all.size() > 1) out += ".SH COMMANDS\n";
  for (std::size_t i = 1; i < all.size(); ++i) {
    out += ".SS \"" + escaped(joined(all[i].path, " ") + usage(all[i])) + "\"\n" + paragraphs(all[i].help);
    for (const OptionWords& positional : all[i].positionals) out += entry(positional);
    for (const OptionWords& option : all[i].options)
      if (option.names.back() != "--help") out += entry(option);
    if (!all[i].footer.empty()) out += ".PP\n" + paragraphs(all[i].footer);
  }
  if (!all.front().footer.empty()) out += ".SH NOTES\n" + paragraphs(all.front().footer);
  return out;
}

}  // namespace longreach
