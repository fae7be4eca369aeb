#include "common/program/command_words.hpp"

namespace longreach {
namespace {

/// "KIND:{a,b}" is KIND, one of a and b.
void split_type(const std::string& type, OptionWords& out) {
  const auto open = type.find('{'), close = type.rfind('}');
  out.what = type.substr(0, open);
  if (!out.what.empty() && out.what.back() == ':') out.what.pop_back();
  if (open == std::string::npos || close == std::string::npos) return;
  std::string word;
  for (const char c : type.substr(open + 1, close - open - 1) + ",") {
    if (c == ',') {
      out.choices.push_back(word);
      word.clear();
    } else {
      word += c;
    }
  }
}

void add_options(const CLI::App& app, CommandWords& out) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;  // hidden
    OptionWords words;
    words.help = option->get_description();
    if (option->get_items_expected_max() > 0) split_type(option->get_type_name(), words);
    if (option->get_positional()) {
      words.what = option->get_name(true);
      out.positionals.push_back(std::move(words));
      continue;
    }
    for (const std::string& name : option->get_snames()) words.names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) words.names.push_back("--" + name);
    out.options.push_back(std::move(words));
  }
}

void add(const CLI::App& app, const std::vector<std::string>& path, bool inherits,
         std::vector<CommandWords>& out) {
  CommandWords words{path, app.get_description(), app.get_footer(), {}, {}, {}, inherits};
  add_options(app, words);
  std::vector<const CLI::App*> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name().empty()) {  // a group of options
      add_options(*command, words);
    } else {
      words.commands.push_back(command->get_name());
      commands.push_back(command);
    }
  }
  out.push_back(std::move(words));
  for (const CLI::App* command : commands) {
    std::vector<std::string> below = path;
    below.push_back(command->get_name());
    add(*command, below, command->get_fallthrough(), out);
  }
}

}  // namespace

std::vector<CommandWords> command_words(const CLI::App& app) {
  std::vector<CommandWords> out;
  add(app, {}, false, out);
  return out;
}

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : between) + word;
  return out;
}

}  // namespace longreach
