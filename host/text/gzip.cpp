#include "host/text/gzip.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <new>

namespace fencepost::host {
namespace {

constexpr int kGzipToo = 16;  // added to the window's bits
constexpr int kMemory = 9;
constexpr std::size_t kPacked = std::size_t{1} << 30U;

}  // namespace

Gzip::Gzip() : stream_(std::make_unique<z_stream_s>()) {
  const int state =
      deflateInit2(stream_.get(), Z_BEST_COMPRESSION, Z_DEFLATED, MAX_WBITS + kGzipToo, kMemory, Z_DEFAULT_STRATEGY);
  if (state != Z_OK) throw std::bad_alloc();
}

Gzip::~Gzip() { deflateEnd(stream_.get()); }

void Gzip::feed(std::string_view bytes) {
  for (; !bytes.empty(); bytes.remove_prefix(std::min(kPacked, bytes.size()))) {
    // zlib does not write to its input.
    stream_->next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream_->avail_in = static_cast<uInt>(std::min(kPacked, bytes.size()));
    pack(Z_NO_FLUSH);
  }
}

void Gzip::finish() { pack(Z_FINISH); }

void Gzip::pack(int flush) {
  std::array<char, 1U << 14U> part;
  do {
    stream_->next_out = reinterpret_cast<Bytef*>(part.data());
    stream_->avail_out = static_cast<uInt>(part.size());
    deflate(stream_.get(), flush);  // its only error is of a stream that was not begun
    packed_.append(part.data(), part.size() - stream_->avail_out);
  } while (stream_->avail_out == 0);
}

std::string gzip(std::string_view bytes) {
  Gzip packer;
  packer.feed(bytes);
  packer.finish();
  return packer.take();
}

}  // namespace fencepost::host
