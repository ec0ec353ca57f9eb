// Packs as gzip does.
#pragma once

#include <memory>
#include <string>
#include <string_view>

struct z_stream_s;

namespace fencepost::host {

/// Bytes in portions to one gzip member. The same bytes give the same: no time, no name.
class Gzip {
 public:
  Gzip();
  Gzip(const Gzip&) = delete;
  Gzip& operator=(const Gzip&) = delete;
  ~Gzip();

  void feed(std::string_view bytes);
  /// The last call.
  void finish();
  /// The packed bytes so far; a whole member after `finish`.
  [[nodiscard]] const std::string& packed() const { return packed_; }
  [[nodiscard]] std::string take() { return std::move(packed_); }

 private:
  void pack(int flush);

  std::unique_ptr<z_stream_s> stream_;
  std::string packed_;
};

std::string gzip(std::string_view bytes);

}  // namespace fencepost::host
