#include <map>
#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/completion.hpp"
#include "host/cli/files.hpp"

namespace fencepost::host::cli {

Command completion_command() {
  return {"completion",
          "the script by which a shell completes what is typed",
          "  fencepost completion bash -o ~/.local/share/bash-completion/completions/fencepost\n"
          "  source <(fencepost completion zsh)\n"
          "  fencepost completion fish | source\n",
          [](CLI::App& app) -> Action {
            const auto shell = std::make_shared<std::string>();
            const auto output = std::make_shared<std::string>("-");
            app.add_option("SHELL", *shell, "whose")->required()->check(CLI::IsMember({"bash", "zsh", "fish"}));
            app.add_option("-o,--output", *output, "where to write; default: standard output")->type_name("FILE");
            return [program = app.get_parent(), shell, output] {
              const CommandWords words = describe(*program);
              write_output(*output, *shell == "bash"  ? bash_completion(words)
                                    : *shell == "zsh" ? zsh_completion(words)
                                                      : fish_completion(words));
              return Exit::kDone;
            };
          },
          {}};
}

}  // namespace fencepost::host::cli
