// A serial port, as hal/linux/tty.cpp has it, by its name COM3.
#include "hal/linux/tty.hpp"

#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <system_error>

namespace fencepost::linux {
namespace {

/// A full output queue is said after so long.
constexpr DWORD kWriteMs = 20;

std::string_view remedy(DWORD error) {
  switch (error) {
    case ERROR_FILE_NOT_FOUND: return "plug it in and switch it on; the Device Manager lists what is there, at Ports";
    case ERROR_ACCESS_DENIED:
    case ERROR_SHARING_VIOLATION: return "another program has it; close that";
    default: return "unplug it and plug it in again; the Device Manager shows what is wrong with it";
  }
}

Problem problem_of(const TtySettings& settings) {
  const DWORD error = ::GetLastError();
  return {"cannot open the serial port " + settings.path + ": " +
          std::system_category().message(static_cast<int>(error)) + "; " + std::string(remedy(error))};
}

/// Raw, 8N1, without flow control; the lines that some adapters take for "there is a program" are on.
bool set_raw_line(HANDLE port, std::uint32_t baud) {
  DCB line{};
  line.DCBlength = sizeof line;
  if (::GetCommState(port, &line) == 0) return false;
  line = {};
  line.DCBlength = sizeof line;
  line.BaudRate = baud;
  line.fBinary = TRUE;
  line.fDtrControl = DTR_CONTROL_ENABLE;
  line.fRtsControl = RTS_CONTROL_ENABLE;
  line.ByteSize = 8;
  line.Parity = NOPARITY;
  line.StopBits = ONESTOPBIT;
  if (::SetCommState(port, &line) == 0) return false;
  // Reads give what is there and never wait.
  COMMTIMEOUTS times{MAXDWORD, 0, 0, 0, kWriteMs};
  return ::SetCommTimeouts(port, &times) != 0;
}

// For this process alone, as all ports are here. Names from COM10 on need the prefix.
Opened<Descriptor> open_line(const TtySettings& settings) {
  const std::string path = settings.path.starts_with("\\\\") ? settings.path : "\\\\.\\" + settings.path;
  const HANDLE port = ::CreateFileA(path.c_str(), GENERIC_READ | GENERIC_WRITE, 0, nullptr, OPEN_EXISTING, 0, nullptr);
  if (port == INVALID_HANDLE_VALUE) return problem_of(settings);
  if (!set_raw_line(port, settings.baud)) {
    Problem problem = problem_of(settings);
    ::CloseHandle(port);
    return problem;
  }
  return Descriptor(::_open_osfhandle(reinterpret_cast<std::intptr_t>(port), _O_BINARY | _O_RDWR));
}

HANDLE handle_of(const Descriptor& fd) { return reinterpret_cast<HANDLE>(::_get_osfhandle(fd.get())); }

}  // namespace

Opened<Tty> Tty::open(TtySettings settings) {
  Opened<Descriptor> line = open_line(settings);
  if (!line) return Problem{line.problem()};
  return Tty(std::move(settings), std::move(*line));
}

Tty::~Tty() { release(); }

void Tty::release() { fd_.close(); }

base::Result<std::size_t> Tty::read(std::span<std::uint8_t> in) {
  if (!fd_.open()) return base::Error::kGone;
  if (in.empty()) return std::size_t{0};
  DWORD count = 0;
  if (::ReadFile(handle_of(fd_), in.data(), static_cast<DWORD>(in.size()), &count, nullptr) == 0) {
    release();
    return base::Error::kGone;
  }
  if (count == 0) return base::Error::kNotReady;
  return std::size_t{count};
}

base::Result<std::size_t> Tty::write(std::span<const std::uint8_t> out) {
  if (!fd_.open()) return base::Error::kGone;
  if (out.empty()) return std::size_t{0};
  DWORD count = 0;
  if (::WriteFile(handle_of(fd_), out.data(), static_cast<DWORD>(out.size()), &count, nullptr) == 0) {
    release();
    return base::Error::kGone;
  }
  if (count == 0) return base::Error::kFull;
  return std::size_t{count};
}

void Tty::tend(base::Time now) {
  if (fd_.open() || !retry_.due(now)) return;
  Opened<Descriptor> line = open_line(settings_);
  problem_ = line ? std::string() : line.problem();
  if (line) fd_ = std::move(*line);
}

}  // namespace fencepost::linux
