// Reads and writes whole files and reports every failure. "-" is standard input or output.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "host/text/gunzip.hpp"

namespace fencepost::host::cli {

/// For messages: the path, or "standard input".
std::string input_name(const std::string& path);

/// The bytes of a file, at most `most`; a gzip file's content, at most kMaxWhole. errors: Failure (kUnreadable):
/// missing, directory, not allowed, read error, longer
std::string read_input(const std::string& path, std::size_t most = kMaxWhole);

/// "-", or another name of standard output: /dev/stdout, /dev/fd/1, /proc/self/fd/1.
bool is_standard_output(const std::string& path);

/// From now on that file is an input, which no result may replace.
void remember_input(int descriptor);

/// A result that is written piece by piece and is there as a whole, or not at all. One at a time.
class OutputFile {
 public:
  /// Makes sure that it can be written. errors: as write_output
  explicit OutputFile(std::string path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  /// Without `finish` nothing was written.
  ~OutputFile();

  void write(std::string_view bytes);
  /// Puts it into its place.
  void finish();

 private:
  class Kind;
  class Descriptor;
  class Device;
  class Replaced;
  std::unique_ptr<Kind> kind_;
};

/// Writes a file under a temporary name beside it, then renames it once it is complete and on the disk. So a full disk
/// never leaves half a file and never destroys an old one. A link stays a link. Devices, pipes and open descriptors
/// (/dev/fd/N) are written directly. A reader of standard output that stops reading is no error.
/// errors: Failure (kUsage): the file is one of the inputs. Failure (kDevice): all others, such as a read-only file in
/// a folder that would let it be replaced
void write_output(const std::string& path, std::string_view bytes);

}  // namespace fencepost::host::cli
