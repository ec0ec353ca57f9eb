// The program for Windows. Streams are bytes, and text is UTF-8; fencepost.manifest has arguments and names of files
// so. Colours are shown where the console knows them.
#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <cstdlib>
#include <initializer_list>

#include "host/cli/program.hpp"

namespace {

UINT code_page_before = 0;

/// A console of Windows 10 and later understands escape sequences, if asked.
bool shows_colours(DWORD stream) {
  const HANDLE console = ::GetStdHandle(stream);
  DWORD mode = 0;
  return ::GetConsoleMode(console, &mode) != 0 &&
         ::SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
}

void prepare_console() {
  for (const int stream : {0, 1, 2}) ::_setmode(stream, _O_BINARY);
  code_page_before = ::GetConsoleOutputCP();
  if (code_page_before != 0) {
    ::SetConsoleOutputCP(CP_UTF8);
    std::atexit([] { ::SetConsoleOutputCP(code_page_before); });
  }
  const bool out = shows_colours(STD_OUTPUT_HANDLE);
  const bool error = shows_colours(STD_ERROR_HANDLE);
  if ((out || error) && std::getenv("TERM") == nullptr) ::_putenv("TERM=windows");
}

}  // namespace

int main(int argc, char** argv) {
  prepare_console();
  return fencepost::host::cli::run_program(argc, argv);
}
