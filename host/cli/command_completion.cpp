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
          [](Options command) -> Action {
            const auto shell = std::make_shared<std::string>();
            const auto output = std::make_shared<std::string>("-");
            command.positional("SHELL", *shell, "whose").required().one_of({"bash", "zsh", "fish"});
            command.value("-o,--output", *output, "where to write; default: standard output").takes("FILE");
            return [command, shell, output] {
              const CommandWords words = command.program();
              write_output(*output, *shell == "bash"  ? bash_completion(words)
                                    : *shell == "zsh" ? zsh_completion(words)
                                                      : fish_completion(words));
              return Exit::kDone;
            };
          },
          {}};
}

}  // namespace fencepost::host::cli
