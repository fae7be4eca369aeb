// Completion: where the words before the cursor lead in the tree of commands, and what may follow there.

#include <algorithm>

#include "common/program/command_words.hpp"
#include "common/program/program_text.hpp"

namespace longreach {
namespace {

std::string key(const CommandWords& command) { return joined(command.path); }

/// Its own options and, where they may stand behind it, those above.
std::vector<OptionWords> options_of(const std::vector<CommandWords>& all, const CommandWords& command) {
  std::vector<OptionWords> out = command.options;
  if (!command.inherits) return out;
  for (const CommandWords& above : all) {
    const bool is_above = above.path.size() < command.path.size() &&
                          std::equal(above.path.begin(), above.path.end(), command.path.begin());
    if (!is_above) continue;
    for (const OptionWords& option : above.options)
      if (option.names.back() != "--help" && option.names.back() != "--version") out.push_back(option);
  }
  return out;
}

std::string names(const std::vector<OptionWords>& options) {
  std::string out;
  for (const OptionWords& option : options)
    for (const std::string& name : option.names)
      if (name.starts_with("--")) out += (out.empty() ? "" : " ") + name;
  return out;
}

/// What a shell offers for a value: "files", "folders", or words.
std::string values(const OptionWords& option) {
  if (!option.choices.empty()) return joined(option.choices);
  if (option.what.starts_with("FILE")) return "@files";
  if (option.what.starts_with("DIR")) return "@folders";
  return "";
}

/// The tables that bash and zsh share: `case` patterns over "COMMAND|WORD" and over COMMAND.
std::string tables(const std::vector<CommandWords>& all) {
  std::string steps, takes, offers;
  for (const CommandWords& command : all) {
    for (const std::string& below : command.commands)
      steps += "      '" + key(command) + "|" + below + "') at='" +
               (key(command).empty() ? "" : key(command) + " ") + below + "'; given=0 ;;\n";
    const std::vector<OptionWords> options = options_of(all, command);
    for (const OptionWords& option : options) {
      if (option.what.empty()) continue;
      for (const std::string& name : option.names)
        takes += "      '" + key(command) + "|" + name + "') value='" +
                 (values(option).empty() ? "@any" : values(option)) + "' ;;\n";
    }
    offers += "    '" + key(command) + "')\n      options='" + names(options) + "'\n      words='" +
              joined(command.commands) + "'\n";
    for (std::size_t i = 0; i < command.positionals.size(); ++i)
      if (const std::string offered = values(command.positionals[i]); !offered.empty())
        offers += "      [ $given = " + std::to_string(i) + " ] && words='" + offered + "'\n";
    offers += "      ;;\n";
  }
  return "  local at= value= given=0 word options= words= i\n"
         "  for ((i = first; i < current; ++i)); do\n"
         "    word=${typed[i]}\n"
         "    if [ -n \"$value\" ]; then value=; continue; fi\n"
         "    case \"$at|$word\" in\n" +
         steps + takes +
         "      *'|-'*) ;;\n"
         "      *) given=$((given + 1)) ;;\n"
         "    esac\n"
         "  done\n"
         "  case \"$at\" in\n" +
         offers + "  esac\n";
}

std::string function_name(std::string program) {
  std::ranges::replace(program, '-', '_');
  return "_" + program;
}

std::string bash(const CLI::App& app) {
  const std::string program = app.get_name(), function = function_name(program);
  return "# Completion of " + program + " for bash, made by " + program + " --completion bash.\n" + function +
         "() {\n"
         "  local -a typed=(\"${COMP_WORDS[@]}\")\n"
         "  local first=1 current=$COMP_CWORD now=${COMP_WORDS[COMP_CWORD]}\n" +
         tables(command_words(app)) +
         "  COMPREPLY=()\n"
         "  [ -n \"$value\" ] && words=$value options=\n"
         "  [[ -z $value && $now == -* ]] && words=$options\n"
         "  case \"$words\" in\n"
         "    @files) compopt -o filenames; mapfile -t COMPREPLY < <(compgen -f -- \"$now\") ;;\n"
         "    @folders) compopt -o filenames; mapfile -t COMPREPLY < <(compgen -d -- \"$now\") ;;\n"
         "    @any) ;;\n"
         "    *) mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$now\") ;;\n"
         "  esac\n"
         "}\n"
         "complete -F " +
         function + " " + program + "\n";
}

std::string zsh(const CLI::App& app) {
  const std::string program = app.get_name();
  return "#compdef " + program + "\n# Completion of " + program + " for zsh, made by " + program +
         " --completion zsh.\n"
         "() {\n"
         "  emulate -L zsh\n"
         "  local -a typed=(\"${words[@]}\")\n"
         "  local first=2 current=$CURRENT now=${typed[CURRENT]}\n" +
         tables(command_words(app)) +
         "  [ -n \"$value\" ] && words=$value options=\n"
         "  [[ -z $value && $now == -* ]] && words=$options\n"
         "  case \"$words\" in\n"
         "    @files) _files ;;\n"
         "    @folders) _files -/ ;;\n"
         "    @any) ;;\n"
         "    *) compadd -- ${=words} ;;\n"
         "  esac\n"
         "}\n";
}

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text)
    out += c == '\'' || c == '\\' ? std::string("\\") + c : c == '\n' ? std::string(" ") : std::string(1, c);
  return out + "'";
}

/// Where the cursor stands: behind all words of the path, and none of the commands below it.
std::string fish_place(const CommandWords& command) {
  std::string out;
  for (const std::string& word : command.path)
    out += (out.empty() ? "" : "; and ") + ("__fish_seen_subcommand_from " + word);
  if (command.commands.empty()) return out;
  return out + (out.empty() ? "" : "; and ") + "not __fish_seen_subcommand_from " + joined(command.commands);
}

std::string fish(const CLI::App& app) {
  const std::string program = app.get_name();
  const std::vector<CommandWords> all = command_words(app);
  std::string out = "# Completion of " + program + " for fish, made by " + program +
                    " --completion fish.\ncomplete -c " + program + " -f\n";
  for (const CommandWords& command : all) {
    const std::string place = fish_place(command);
    const std::string head = "complete -c " + program + (place.empty() ? "" : " -n " + quoted(place));
    for (const CommandWords& below : all) {
      if (below.path.size() != command.path.size() + 1 ||
          !std::equal(command.path.begin(), command.path.end(), below.path.begin()))
        continue;
      out += head + " -a " + below.path.back() + " -d " + quoted(below.help) + "\n";
    }
    for (const OptionWords& option : options_of(all, command)) {
      out += head;
      for (const std::string& name : option.names)
        out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (!option.what.empty()) {
        const std::string offered = values(option);
        out += offered == "@files"     ? " -rF"
               : offered == "@folders" ? " -x -a '(__fish_complete_directories)'"
               : offered.empty()       ? " -x"
                                       : " -x -a " + quoted(offered);
      }
      out += " -d " + quoted(option.help) + "\n";
    }
    for (const OptionWords& positional : command.positionals)
      if (const std::string offered = values(positional); !offered.empty())
        out += head +
               (offered == "@files"     ? " -F"
                : offered == "@folders" ? " -a '(__fish_complete_directories)'"
                                        : " -a " + quoted(offered)) +
               "\n";
  }
  return out;
}

}  // namespace

std::string completion(const CLI::App& app, const std::string& shell) {
  if (shell == "bash") return bash(app);
  return shell == "zsh" ? zsh(app) : fish(app);
}

void add_manual_options(CLI::App& app, const std::string& title) {
  // What ends a parse with a text and status 0 is called a version by the parser.
  const auto print = [](std::string text) {
    text.pop_back();
    throw CLI::CallForVersion(text, 0);
  };
  app.add_flag_callback(
      "--man", [&app, title, print] { print(manual_page(app, title)); }, "Print the manual page");
  app.add_option_function<std::string>(
         "--completion", [&app, print](const std::string& shell) { print(completion(app, shell)); },
         "Print the completion of a shell")
      ->type_name("SHELL")
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
}

}  // namespace longreach
