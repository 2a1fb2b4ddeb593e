// SPDX-License-Identifier: Apache-2.0
#include "commands.h"
#include <fmt/format.h>

#include <memory>
#include <string>

namespace trysquare::app {
namespace {

constexpr const char* kFooter = R"(Examples:
  trysquare completion bash > ~/.local/share/bash-completion/completions/trysquare
  trysquare completion fish > ~/.config/fish/completions/trysquare.fish)";

std::string verbs_of(const CLI::App& app) {
  std::string text;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) text += verb->get_name() + " ";
  return text;
}

std::string options_of(const CLI::App& verb) {
  std::string text;
  for (const CLI::Option* option : verb.get_options()) {
    for (const std::string& name : option->get_lnames()) text += "--" + name + " ";
  }
  return text;
}

/// The cases of a shell `case` statement: the options of every verb.
std::string option_cases(const CLI::App& app, const char* format) {
  std::string text;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    text += fmt::format(fmt::runtime(format), verb->get_name(), options_of(*verb));
  }
  return text;
}

std::string bash(const CLI::App& app) {
  return fmt::format(R"(_trysquare() {{
  local word="${{COMP_WORDS[COMP_CWORD]}}" words=""
  if [ "$COMP_CWORD" -eq 1 ]; then
    words="{}"
  elif [[ "$word" == -* ]]; then
    case "${{COMP_WORDS[1]}}" in
{}    esac
  fi
  if [ -n "$words" ]; then COMPREPLY=($(compgen -W "$words" -- "$word")); else COMPREPLY=($(compgen -f -- "$word")); fi
}}
complete -o filenames -F _trysquare trysquare
)",
                     verbs_of(app), option_cases(app, "      {}) words=\"{}\" ;;\n"));
}

std::string zsh(const CLI::App& app) {
  return "#compdef trysquare\nautoload -U +X bashcompinit && bashcompinit\n" + bash(app);
}

std::string fish(const CLI::App& app) {
  std::string text = fmt::format("complete -c trysquare -n __fish_use_subcommand -f -a '{}'\n", verbs_of(app));
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    for (const CLI::Option* option : verb->get_options()) {
      for (const std::string& name : option->get_lnames()) {
        text +=
            fmt::format("complete -c trysquare -n '__fish_seen_subcommand_from {}' -l {}\n", verb->get_name(), name);
      }
    }
  }
  return text;
}

}  // namespace

void add_completion(CLI::App& app) {
  auto shell = std::make_shared<std::string>();
  CLI::App& verb = *app.add_subcommand("completion", "Prints the completion script of a shell");
  verb.footer(kFooter);
  verb.add_option("SHELL", *shell, "bash, zsh or fish")->required()->check(CLI::IsMember({"bash", "zsh", "fish"}));
  verb.callback([shell, &app] {
    const std::string script = *shell == "bash" ? bash(app) : *shell == "zsh" ? zsh(app) : fish(app);
    fmt::print("{}", script);
  });
}

}  // namespace trysquare::app
