#include "host/text/gunzip.hpp"

#include <zlib.h>

#include <array>

namespace fencepost::host {
namespace {

constexpr int kGzipOnly = 16;  // added to the window's bits

class Inflater {
 public:
  explicit Inflater(std::string_view bytes) {
    // zlib does not write to its input.
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream_.avail_in = static_cast<uInt>(bytes.size());
    ready_ = inflateInit2(&stream_, MAX_WBITS + kGzipOnly) == Z_OK;
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  bool member(std::string& out) {
    std::array<char, 1 << 16> chunk;
    int state = ready_ ? Z_OK : Z_DATA_ERROR;
    while (state == Z_OK) {
      stream_.next_out = reinterpret_cast<Bytef*>(chunk.data());
      stream_.avail_out = static_cast<uInt>(chunk.size());
      state = inflate(&stream_, Z_NO_FLUSH);
      out.append(chunk.data(), chunk.size() - stream_.avail_out);
    }
    return state == Z_STREAM_END;
  }
  /// More of them follow.
  bool next() { return stream_.avail_in > 0 && inflateReset(&stream_) == Z_OK; }

 private:
  z_stream stream_{};
  bool ready_ = false;
};

}  // namespace

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

std::optional<std::string> gunzip(std::string_view bytes) {
  if (bytes.size() > UINT32_MAX) return std::nullopt;
  Inflater inflater(bytes);
  std::string out;
  do {
    if (!inflater.member(out)) return std::nullopt;
  } while (inflater.next());
  return out;
}

}  // namespace fencepost::host
