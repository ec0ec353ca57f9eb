// The field order, decimals and ranges of every record, said once: the encoder and the decoder both walk this.
// `Fields` is a FieldWriter (then Record is const) or a FieldReader.
#pragma once

#include <concepts>
#include <type_traits>

#include "firmware/record/decimal.hpp"
#include "firmware/record/kinds.hpp"
#include "firmware/record/records.hpp"

namespace fencepost::record {

inline constexpr NumberField kTime{0, 9'999'990'000, 4};             // 0..999999 s
inline constexpr NumberField kPosition{-10'000'000, 10'000'000, 4};  // +-1000 m
inline constexpr NumberField kMagnitude{0, 10'000'000, 4};           // radii and standard deviations, to 1000 m or rad
inline constexpr NumberField kDistance{0, 30'000'000, 4};            // across the whole map: sqrt(2) * 2000 m and some
inline constexpr NumberField kHeading{-10'000'000, 10'000'000, 4};   // +-1000 rad, wrapped or not
inline constexpr NumberField kTurnRate{-1'000'000, 1'000'000, 4};    // +-100 rad/s: gyros end at 35
inline constexpr NumberField kEncoderCount{-2'147'483'648, 2'147'483'647, 0};
inline constexpr NumberField kPitch{-15'708, 15'708, 4};         // +-90 deg
inline constexpr NumberField kLatency{0, 100'000, 4};            // 10 s: more is milliseconds by mistake
inline constexpr NumberField kDistortion{-100'000, 100'000, 4};  // +-10: lenses have less than 1
inline constexpr NumberField kConfidence{0, 100, 2};             // 0..1
inline constexpr NumberField kFactor{1, 10'000, 2};              // 0.01..100
inline constexpr NumberField kCurvature{-10'000, 10'000, 2};     // 1/m: a radius of 1 cm
inline constexpr NumberField kPixel{-32'768, 32'767, 0};
inline constexpr NumberField kCentroid{-327'680, 327'670, 1};
inline constexpr NumberField kPrincipalPoint{-3'276'800, 3'276'700, 2};
inline constexpr NumberField kFocalLength{1, 3'276'700, 2};
inline constexpr NumberField kImageSize{2, 32'767, 0};
inline constexpr NumberField kCount{0, 4'294'967'295, 0};
inline constexpr NumberField kSignature{0, 255, 0};
inline constexpr NumberField kTrack{1, 65'535, 0};
inline constexpr NumberField kWidth{1, 2'000, 3};  // of a thing: what is larger is a wall
inline constexpr NumberField kPad{-100, 100, 0};   // px; networks were seen to pad by 7
inline constexpr NumberField kFormatNumber{kStreamFormat, kStreamFormat, 0};

template <class Record, class X>
concept Is = std::same_as<std::remove_const_t<Record>, X>;

template <class Fields, Is<Header> Record>
void walk(Fields& fields, Record& r) {
  fields.number(r.format, kFormatNumber);
  fields.text(r.product);
  fields.text(r.version);
  fields.text(r.target);
  fields.text(r.profile);
}

template <class Fields, Is<sensor::CameraIntrinsics> Record>
void walk(Fields& fields, Record& r) {
  fields.text(r.model);
  fields.number(r.width, kImageSize);
  fields.number(r.height, kImageSize);
  fields.number(r.fx.raw, kFocalLength);
  fields.number(r.fy.raw, kFocalLength);
  fields.number(r.cx.raw, kPrincipalPoint);
  fields.number(r.cy.raw, kPrincipalPoint);
  fields.number(r.k1.raw, kDistortion);
  fields.number(r.mount.x.raw, kPosition);
  fields.number(r.mount.y.raw, kPosition);
  fields.number(r.mount.z.raw, kPosition);
  fields.number(r.mount.yaw.raw, kHeading);
  fields.number_or_empty(r.mount.pitch, kPitch);
  fields.number(r.latency.raw, kLatency);
  fields.last_word(r.lens, sensor::Lens::kEquidistant);
}

template <class Fields, Is<Signature> Record>
void walk(Fields& fields, Record& r) {
  fields.number(r.signature, kSignature);
  fields.colour(r.rgb);
  fields.text(r.name);
  fields.last_numbers(r.width, kWidth, r.pad, kPad);
}

template <class Fields, Is<sensor::OdometrySample> Record>
void walk(Fields& fields, Record& r) {
  fields.time_or_arrival(r.t, kTime);
  fields.number(r.x.raw, kPosition);
  fields.number(r.y.raw, kPosition);
  fields.number(r.heading.raw, kHeading);
}

template <class Fields, Is<sensor::CarSample> Record>
void walk(Fields& fields, Record& r) {
  fields.time_or_arrival(r.t, kTime);
  fields.number(r.count, kEncoderCount);
  fields.number_or_empty(r.steering, kPitch);
  fields.number_or_empty(r.yaw_rate, kTurnRate);
}

template <class Fields, Is<sensor::Blob> Record>
void walk(Fields& fields, Record& r) {
  fields.number(r.signature, kSignature);
  // A bearing has no columns: both are empty.
  const bool bearing = fields.left_empty(r.bearing);
  if (!bearing) fields.number(r.x1, kPixel);
  fields.number(r.y1, kPixel);
  if (bearing) {
    fields.empty(1);
  } else {
    fields.number(r.x2, kPixel);
  }
  fields.number(r.y2, kPixel);
  fields.require((bearing || r.x1 <= r.x2) && r.y1 <= r.y2);
  fields.number(r.cx.raw, kCentroid);
  if constexpr (!std::is_const_v<Record>) {
    if (bearing) sensor::put_at_centre(r);
  }
  fields.number(r.cy.raw, kCentroid);
  fields.number(r.pixels, kCount);
  fields.colour_or_empty(r.rgb);
  fields.extra_number(r.track, kTrack);
}

template <class Fields, Is<sensor::BlobFrame> Record>
void walk(Fields& fields, Record& r) {
  fields.number(r.t.raw, kTime);
  fields.number(r.frame, kCount);
  fields.list_with_extra(r.blobs, kBlobFields, [](const sensor::Blob& blob) { return blob.track != 0; });
}

template <class Fields, Is<Position> Record>
void walk(Fields& fields, Record& r) {
  fields.number(r.t.raw, kTime);
  fields.number(r.x.raw, kPosition);
  fields.number(r.y.raw, kPosition);
  fields.number(r.heading.raw, kHeading);
  fields.number(r.sigma_xy.raw, kMagnitude);
  fields.number(r.sigma_heading.raw, kMagnitude);
}

template <class Fields, Is<ObjectReport> Record>
void walk(Fields& fields, Record& r) {
  fields.number(r.t.raw, kTime);
  fields.number(r.id, kCount);
  fields.number(r.signature, kSignature);
  fields.number(r.views, kCount);
  fields.number(r.x.raw, kPosition);
  fields.number(r.y.raw, kPosition);
  fields.number(r.radius.raw, kMagnitude);
  fields.number(r.z_min.raw, kPosition);
  fields.number(r.z_max.raw, kPosition);
  fields.number(r.bearing.raw, kHeading);
  fields.number(r.distance.raw, kDistance);
  fields.number(r.confidence.raw, kConfidence);
  fields.word(r.state, ObjectState::kLost);
}

template <class Fields, Is<AlertReport> Record>
void walk(Fields& fields, Record& r) {
  fields.number(r.t.raw, kTime);
  fields.word(r.level, AlertLevel::kBlind);
  fields.number(r.id, kCount);
  fields.number(r.signature, kSignature);
  if (r.level == AlertLevel::kBlind) return fields.empty(4);
  fields.number(r.bearing.raw, kHeading);
  fields.number(r.distance.raw, kDistance);
  fields.number_or_empty(r.ttc, kTime);
  fields.number(r.confidence.raw, kConfidence);
}

template <class Fields, Is<Heartbeat> Record>
void walk(Fields& fields, Record& r) {
  fields.number(r.t.raw, kTime);
  fields.word(r.level, AlertLevel::kBlind);
  fields.word(r.camera, sensor::LinkState::kOk);
  fields.word(r.odometry, sensor::LinkState::kOk);
}

template <class Fields, Is<SpeedLimit> Record>
void walk(Fields& fields, Record& r) {
  fields.number(r.t.raw, kTime);
  fields.number_or_empty(r.speed, kDistance);
}

template <class Fields, Is<CalibrationDoubt> Record>
void walk(Fields& fields, Record& r) {
  fields.number(r.t.raw, kTime);
  fields.word(r.doubt, Doubt::kLens);
  fields.number(r.factor.raw, kFactor);
}

template <class Fields, Is<DigestReport> Record>
void walk(Fields& fields, Record& r) {
  fields.number(r.frame, kCount);
  fields.digest(r.digest);
}

template <class Fields, Is<LinkReport> Record>
void walk(Fields& fields, Record& r) {
  fields.number(r.t.raw, kTime);
  fields.text(r.device);
  fields.word(r.state, sensor::LinkState::kOk);
  fields.text(r.detail);
}

template <class Fields, Is<StatusReport> Record>
void walk(Fields& fields, Record& r) {
  fields.number(r.t.raw, kTime);
  fields.number(r.frames, kCount);
  fields.number(r.blobs, kCount);
  fields.number(r.blobs_dropped, kCount);
  fields.number(r.odometry, kCount);
  fields.number(r.rejected, kCount);
  fields.number(r.refused, kCount);
  fields.number(r.records_dropped, kCount);
  fields.number(r.objects, kCount);
  fields.number(r.loop_us_max, kCount);
}

template <class Fields, Is<SectorReport::Sector> Record>
void walk(Fields& fields, Record& r) {
  fields.number_or_empty(r.distance, kDistance);
}

template <class Fields, Is<SectorReport> Record>
void walk(Fields& fields, Record& r) {
  fields.number(r.t.raw, kTime);
  fields.list(r.sectors, 1);
}

template <class Fields, Is<WayReport::Way> Record>
void walk(Fields& fields, Record& r) {
  fields.word(r.motion, WayMotion::kSpin);
  fields.number(r.curvature.raw, kCurvature);
  fields.number(r.free.raw, kDistance);
  fields.number(r.speed.raw, kDistance);
  fields.word(r.end, WayEnd::kUnknown);
}

template <class Fields, Is<WayReport> Record>
void walk(Fields& fields, Record& r) {
  fields.number(r.t.raw, kTime);
  fields.list(r.ways, 5);
}

template <class Fields, Is<Setting> Record>
void walk(Fields& fields, Record& r) {
  fields.text(r.key);
  fields.text(r.value);
}

}  // namespace fencepost::record
