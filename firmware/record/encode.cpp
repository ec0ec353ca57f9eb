#include "firmware/record/encode.hpp"

#include "firmware/record/field_writer.hpp"
#include "firmware/record/layout.hpp"

namespace fencepost::record {
namespace {

template <class Record>
std::size_t write(Kind kind, const Record& record, std::span<char> line) {
  FieldWriter fields(kind, line);
  walk(fields, record);
  return fields.finish();
}

}  // namespace

std::size_t encode(const Header& record, std::span<char> line) { return write(Kind::kHeader, record, line); }

std::size_t encode(const sensor::CameraIntrinsics& record, std::span<char> line) {
  return write(Kind::kCamera, record, line);
}

std::size_t encode(const Signature& record, std::span<char> line) { return write(Kind::kSignature, record, line); }

std::size_t encode(const sensor::OdometrySample& record, std::span<char> line) {
  return write(Kind::kOdometry, record, line);
}

std::size_t encode(const sensor::BlobFrame& record, std::span<char> line) { return write(Kind::kFrame, record, line); }

std::size_t encode(const Position& record, std::span<char> line) { return write(Kind::kPosition, record, line); }

std::size_t encode(const ObjectReport& record, std::span<char> line) { return write(Kind::kObject, record, line); }

std::size_t encode(const AlertReport& record, std::span<char> line) { return write(Kind::kAlert, record, line); }

std::size_t encode(const DigestReport& record, std::span<char> line) { return write(Kind::kDigest, record, line); }

std::size_t encode(const LinkReport& record, std::span<char> line) { return write(Kind::kLink, record, line); }

std::size_t encode(const StatusReport& record, std::span<char> line) { return write(Kind::kStatus, record, line); }

std::size_t encode(const Setting& record, std::span<char> line) { return write(Kind::kSetting, record, line); }

}  // namespace fencepost::record
