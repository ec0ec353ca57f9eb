#include "host/cli/system.hpp"

#include <io.h>
#include <windows.h>

#include <array>
#include <string_view>

#include "host/live/place.hpp"

namespace fencepost::host::cli {

namespace fs = std::filesystem;

// Beside the program: what was unpacked stays together.
fs::path installed_share() {
  std::array<wchar_t, 32'768> path{};
  const DWORD size = ::GetModuleFileNameW(nullptr, path.data(), path.size());
  if (size == 0 || size == path.size()) return {};
  return fs::path(std::wstring_view(path.data(), size)).parent_path() / "share" / "fencepost";
}

bool names_device(const std::string& path) { return is_com_port(path); }

std::optional<FileId> id_of_file(int descriptor) {
  const HANDLE file = reinterpret_cast<HANDLE>(::_get_osfhandle(descriptor));
  BY_HANDLE_FILE_INFORMATION about{};
  if (::GetFileType(file) != FILE_TYPE_DISK || ::GetFileInformationByHandle(file, &about) == 0) return std::nullopt;
  return FileId{about.dwVolumeSerialNumber,
                (std::uint64_t{about.nFileIndexHigh} << 32U) + std::uint64_t{about.nFileIndexLow}};
}

}  // namespace fencepost::host::cli
