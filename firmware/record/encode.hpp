// Records to lines. Byte-reproducible: the same record gives the same bytes on every target.
#pragma once

#include <cstddef>
#include <span>

#include "firmware/record/records.hpp"

namespace fencepost::record {

/// Writes the whole line, CRC and "\r\n" included, and returns its length; kMaxLine characters hold any line.
/// Returns 0 if the line does not fit into `line` or into kMaxLine, or if a value is outside the range of its
/// field: a record that a reader would reject is never written. `line` then holds nothing of use.
[[nodiscard]] std::size_t encode(const Header& record, std::span<char> line);
[[nodiscard]] std::size_t encode(const sensor::CameraIntrinsics& record, std::span<char> line);
[[nodiscard]] std::size_t encode(const Signature& record, std::span<char> line);
[[nodiscard]] std::size_t encode(const sensor::OdometrySample& record, std::span<char> line);
[[nodiscard]] std::size_t encode(const sensor::BlobFrame& record, std::span<char> line);
[[nodiscard]] std::size_t encode(const Position& record, std::span<char> line);
[[nodiscard]] std::size_t encode(const ObjectReport& record, std::span<char> line);
[[nodiscard]] std::size_t encode(const AlertReport& record, std::span<char> line);
[[nodiscard]] std::size_t encode(const DigestReport& record, std::span<char> line);
[[nodiscard]] std::size_t encode(const LinkReport& record, std::span<char> line);
[[nodiscard]] std::size_t encode(const StatusReport& record, std::span<char> line);
[[nodiscard]] std::size_t encode(const Setting& record, std::span<char> line);

}  // namespace fencepost::record
