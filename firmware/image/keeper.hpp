// Keeps settings, calibration and signatures in flash, as the stream's own lines.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "firmware/config/settings_store.hpp"
#include "firmware/loop/pipeline.hpp"
#include "firmware/record/decode.hpp"
#include "firmware/record/encode.hpp"

namespace fencepost::image {

template <class Profile, bus::FlashPages Flash>
class Keeper {
 public:
  Keeper(loop::Pipeline<Profile>& pipeline, Flash& flash) : pipeline_(pipeline), store_(flash) {}

  /// At start-up, after the pipeline was offered devices: what was kept comes into force. The calibration of another
  /// camera - one that this image does not contain, of another size - is passed over.
  void restore() {
    store_.load([this](std::string_view line) {
      Restored restored{pipeline_};
      static_cast<void>(record::decode(line, {}, restored));
    });
    if (pipeline_.memory().offer != nullptr) pipeline_.end_restoring();
    remember();
  }

  /// Writes the changes. False if the flash could not be written; those changes are then not tried again.
  bool keep() {
    const loop::Memory<Profile>& memory = pipeline_.memory();
    if (memory.devices == devices_ && memory.settings == settings_ && memory.calibration.intrinsics == camera_ &&
        memory.signatures == signatures_) {
      return true;
    }
    const bool kept = write_changes();
    remember();
    return kept;
  }

 private:
  using Line = std::array<char, config::SettingsStore<Flash>::kMaxLine>;

  struct Restored {
    loop::Pipeline<Profile>& pipeline;

    void accept(const record::Setting& setting) {
      static_cast<void>(pipeline.set(setting.key.view(), setting.value.view()));
      if (pipeline.memory().offer != nullptr) pipeline.restore_device(setting.key.view(), setting.value.view());
    }
    void accept(const record::Signature& signature) { static_cast<void>(pipeline.set_signature(signature)); }
    void accept(const sensor::CameraIntrinsics& camera) {
      const loop::Calibration& built_in = pipeline.memory().calibration;
      const bool other =
          built_in.known && (camera.width != built_in.intrinsics.width || camera.height != built_in.intrinsics.height);
      if (!other) pipeline.set_camera(camera);
    }
    template <class Record>
    void accept(const Record& /*no input of start-up*/) {}
  };

  [[nodiscard]] record::Setting setting(config::Key key) const {
    return {config::info(key).name, pipeline_.memory().settings.text(key)};
  }

  [[nodiscard]] record::Setting setting(config::DeviceKey key) const {
    return {config::info(key).name, pipeline_.memory().devices.text(key)};
  }

  // Appends all changes since the last time, or none. If the page is full, it writes all settings anew into the other.
  [[gnu::noinline]] bool write_changes() {
    Line line{};
    const auto tell = [&](bool all) { return [this, &line, all](auto& put) { write(line, put, all); }; };
    return store_.append(tell(false)) || store_.rewrite(tell(true));
  }

  // `all`: that is not as in a fresh image.
  template <class Put>
  void write(Line& line, Put& put, bool all) const {
    const loop::Memory<Profile>& memory = pipeline_.memory();
    const config::Devices& devices = all && memory.offer != nullptr ? memory.offer->limits.initial : devices_;
    for (std::size_t i = 0; i < config::kDeviceKeys; ++i) {  // before the calibration, which they change
      const auto key = static_cast<config::DeviceKey>(i);
      if (memory.devices.raw(key) != devices.raw(key)) put(text_of(setting(key), line));
    }
    for (std::size_t i = 0; i < config::kKeys; ++i) {
      const auto key = static_cast<config::Key>(i);
      const std::int32_t before = all ? config::info(key).initial : settings_.raw(key);
      if (memory.settings.raw(key) != before) put(text_of(setting(key), line));
    }
    const bool moved = all || memory.calibration.intrinsics != camera_;
    if (memory.calibration.known && moved) put(text_of(memory.calibration.intrinsics, line));
    for (std::size_t i = 0; i < memory.signatures.size(); ++i) {
      const bool same = !all && i < signatures_.size() && memory.signatures[i] == signatures_[i];
      if (!same) put(text_of(memory.signatures[i], line));
    }
  }

  template <class Record>
  static std::string_view text_of(const Record& record, Line& line) {
    const std::size_t size = record::encode(record, line);
    return {line.data(), size > 2 ? size - 2 : 0};  // its line end is not kept
  }

  void remember() {
    const loop::Memory<Profile>& memory = pipeline_.memory();
    devices_ = memory.devices;
    settings_ = memory.settings;
    camera_ = memory.calibration.intrinsics;
    signatures_ = memory.signatures;
  }

  loop::Pipeline<Profile>& pipeline_;
  config::SettingsStore<Flash> store_;
  // As they were when they were last written.
  config::Devices devices_;
  config::Settings settings_;
  sensor::CameraIntrinsics camera_;
  base::FixedVector<record::Signature, Profile::kSignatures> signatures_;
};

}  // namespace fencepost::image
