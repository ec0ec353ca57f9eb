#include "drivers/cmucam/measure.hpp"

#include <algorithm>
#include <span>

namespace fencepost::cmucam {
namespace {

/// The fields by name, in the camera's coordinates.
struct Fields {
  std::uint8_t mx = 0;  ///< whole centroid
  std::uint8_t my = 0;
  bool has_centroid = true;
  std::uint8_t x1 = 0;
  std::uint8_t y1 = 0;
  std::uint8_t x2 = 0;
  std::uint8_t y2 = 0;
  std::uint8_t pixels = 0;
  std::uint8_t confidence = 0;
};

std::uint32_t area(const Fields& fields, PixelCount rule) {
  // 254 is what a raw packet makes of 255.
  const bool saturated = fields.pixels >= 254;
  const auto box = static_cast<std::uint32_t>((fields.x2 - fields.x1 + 1) * (fields.y2 - fields.y1 + 1));
  switch (rule) {
    case PixelCount::kUnknown: return 0;
    case PixelCount::kCount: return saturated ? 0 : fields.pixels;
    case PixelCount::kEighths: return saturated ? 0 : std::min<std::uint32_t>(8U * fields.pixels, box);
    case PixelCount::kByConfidence: return (fields.confidence * box + 127) / 255;
  }
  return 0;
}

Fields named(const Packet& packet) {
  std::span<const std::uint8_t> raw(packet.fields.data(), packet.count);
  Fields fields;
  if (packet.letter == 'N') raw = raw.subspan(1);
  fields.has_centroid = packet.letter != 'C';
  if (fields.has_centroid) {
    fields.mx = raw[0];
    fields.my = raw[1];
    raw = raw.subspan(2);
  }
  fields.x1 = raw[0];
  fields.y1 = raw[1];
  fields.x2 = raw[2];
  fields.y2 = raw[3];
  fields.pixels = raw[4];
  fields.confidence = raw[5];
  return fields;
}

bool fits(const Fields& fields, const Dialect& dialect) {
  const int first = dialect.first_pixel;
  const bool inside = fields.x1 >= first && fields.y1 >= first && fields.x2 < dialect.width + first &&
                      fields.y2 < dialect.height + first;
  const bool ordered = fields.x1 <= fields.x2 && fields.y1 <= fields.y2;
  const bool centred = !fields.has_centroid || (fields.mx >= fields.x1 && fields.mx <= fields.x2 &&
                                                fields.my >= fields.y1 && fields.my <= fields.y2);
  return inside && ordered && centred;
}

base::Pixels1 centre(const Fields& fields, int whole, int low, int high, int first) {
  if (fields.has_centroid) return {10 * (whole - first)};
  return {5 * (low + high - 2 * first)};
}

}  // namespace

base::Result<sensor::Blob> to_blob(const Packet& packet, const Dialect& dialect, std::uint8_t signature) {
  if (packet.letter == 'S') return base::Error::kBadInput;
  const Fields fields = named(packet);
  if (std::all_of(packet.fields.begin(), packet.fields.end(), [](std::uint8_t f) { return f == 0; })) {
    return base::Error::kNotReady;
  }
  if (packet.letter == 'N' && fields.x2 == 0 && fields.confidence == 0) return base::Error::kNotReady;
  if (!fits(fields, dialect)) return base::Error::kBadInput;
  if (fields.confidence < dialect.min_confidence) return base::Error::kNotReady;
  const int first = dialect.first_pixel;
  sensor::Blob blob;
  blob.signature = signature;
  blob.x1 = static_cast<std::int16_t>(fields.x1 - first);
  blob.y1 = static_cast<std::int16_t>(fields.y1 - first);
  blob.x2 = static_cast<std::int16_t>(fields.x2 - first);
  blob.y2 = static_cast<std::int16_t>(fields.y2 - first);
  blob.cx = centre(fields, fields.mx, fields.x1, fields.x2, first);
  blob.cy = centre(fields, fields.my, fields.y1, fields.y2, first);
  blob.pixels = area(fields, dialect.pixels);
  return blob;
}

}  // namespace fencepost::cmucam
