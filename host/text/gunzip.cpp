#include "host/text/gunzip.hpp"

#include <zlib.h>

#include <algorithm>

namespace fencepost::host {
namespace {

constexpr int kGzipOnly = 16;  // added to the window's bits
constexpr std::size_t kPortion = std::size_t{1} << 30U;

}  // namespace

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

Gunzip::Gunzip() : stream_(std::make_unique<z_stream_s>()) {
  damaged_ = inflateInit2(stream_.get(), MAX_WBITS + kGzipOnly) != Z_OK;
}

Gunzip::~Gunzip() { inflateEnd(stream_.get()); }

void Gunzip::feed(std::string_view packed) {
  // zlib does not write to its input.
  stream_->next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream_->avail_in = static_cast<uInt>(packed.size());
}

std::string_view Gunzip::next() {
  while (!damaged_) {
    if (between_members_ && stream_->avail_in == 0) return {};
    if (between_members_) damaged_ = inflateReset(stream_.get()) != Z_OK;
    between_members_ = false;
    stream_->next_out = reinterpret_cast<Bytef*>(chunk_.data());
    stream_->avail_out = static_cast<uInt>(chunk_.size());
    const int state = inflate(stream_.get(), Z_NO_FLUSH);
    between_members_ = state == Z_STREAM_END;
    damaged_ = state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR;
    const std::size_t size = chunk_.size() - stream_->avail_out;
    if (size > 0) return {chunk_.data(), size};
    if (!between_members_ && stream_->avail_in == 0) return {};
  }
  return {};
}

std::optional<std::string> gunzip(std::string_view bytes, std::size_t most) {
  Gunzip unpacker;
  std::string out;
  if (bytes.empty()) return std::nullopt;
  for (; !bytes.empty(); bytes.remove_prefix(std::min(kPortion, bytes.size()))) {
    unpacker.feed(bytes.substr(0, kPortion));
    for (std::string_view part = unpacker.next(); !part.empty(); part = unpacker.next()) {
      out += part;
      if (out.size() > most) return out;
    }
    if (unpacker.damaged()) return std::nullopt;
  }
  if (!unpacker.complete()) return std::nullopt;
  return out;
}

}  // namespace fencepost::host
