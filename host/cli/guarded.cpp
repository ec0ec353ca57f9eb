#include "host/cli/guarded.hpp"

#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>

#include "host/cli/exit_code.hpp"
#include "host/cli/terminal.hpp"

namespace fencepost::host::cli {
namespace {

int fail(Exit code, const std::string& message) {
  say("fencepost: " + message);
  return static_cast<int>(code);
}

}  // namespace

int guarded(const std::function<int()>& command) {
  try {
    return command();
  } catch (const Failure& failure) {
    return fail(failure.code(), failure.what());
  } catch (const std::bad_alloc&) {
    return fail(Exit::kUnreadable, "out of memory; free some, or give it a part of the input");
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(Exit::kUnreadable,
                "cannot read " + error.path1().string() + ": " + error.code().message() + "; check the path");
  } catch (const std::system_error& error) {
    return fail(Exit::kDevice,
                std::string("the system refused something: ") + error.what() + "; see the limits of 'ulimit -a'");
  } catch (const std::exception& error) {
    return fail(Exit::kUnreadable, std::string("something in the input was not foreseen: ") + error.what() +
                                       "; please report it, with the input and this command line");
  }
}

}  // namespace fencepost::host::cli
