// Behind the C interface's handle: a Core of a size that is chosen at run time.
#pragma once

#include <memory>

#include "firmware/fencepost/core.hpp"

/// The functions of Core, whatever its size.
struct fencepost_core {
  virtual fencepost::Answer set_camera(const fencepost::Camera& camera) = 0;
  virtual fencepost::Answer set(const char* key, const char* value) = 0;
  virtual fencepost::Answer set(const char* key, float value) = 0;
  virtual fencepost::Answer set_colour(const fencepost_colour& colour) = 0;
  virtual fencepost::Answer set_name(std::uint8_t signature, const char* name) = 0;
  virtual void on_alert(void (*function)(void* context, const fencepost::Alert& alert), void* context) = 0;
  virtual void on_log(fencepost_log_function function, void* context) = 0;
  virtual fencepost::Answer odometry(std::int64_t time, const fencepost::Pose& pose) = 0;
  virtual fencepost::Answer boxes(std::int64_t time, const fencepost_box* first, std::size_t count) = 0;
  virtual void step(std::int64_t now) = 0;
  virtual void restart() = 0;
  [[nodiscard]] virtual fencepost::Level level() const = 0;
  virtual bool may_drive(std::int64_t now) = 0;
  [[nodiscard]] virtual float speed_limit() const = 0;
  virtual std::size_t objects(fencepost::Object* to, std::size_t most) const = 0;
  virtual std::size_t outline(std::uint32_t id, fencepost::Point* to, std::size_t most) const = 0;
  virtual std::size_t sectors(float* to, std::size_t most) const = 0;
  virtual std::size_t ways(fencepost_way* to, std::size_t most, const fencepost_passing_rule* rules,
                           std::size_t count) const = 0;
  virtual bool pose(fencepost::Pose& to) const = 0;
  [[nodiscard]] virtual std::uint64_t digest() const = 0;

  fencepost_alert_function hear = nullptr;
  void* hear_context = nullptr;

 protected:
  ~fencepost_core() = default;
};

struct fencepost_capacity {
  std::size_t bytes;
  std::size_t objects;
  fencepost_core* (*make)(void* memory);
};

namespace fencepost::library {

template <class Size>
class SizedCore final : public fencepost_core {
 public:
  Answer set_camera(const Camera& camera) override { return core_.set_camera(camera); }
  Answer set(const char* key, const char* value) override { return core_.set(key, value); }
  Answer set(const char* key, float value) override { return core_.set(key, value); }
  Answer set_colour(const Colour& colour) override { return core_.set_colour(colour); }
  Answer set_name(std::uint8_t signature, const char* name) override { return core_.set_name(signature, name); }
  void on_alert(typename Core<Size>::AlertFunction function, void* context) override {
    core_.on_alert(function, context);
  }
  void on_log(fencepost_log_function function, void* context) override { core_.on_log(function, context); }
  Answer odometry(std::int64_t time, const Pose& pose) override { return core_.odometry(time, pose); }
  Answer boxes(std::int64_t time, const fencepost_box* first, std::size_t count) override {
    return core_.boxes(time, first, count);
  }
  void step(std::int64_t now) override { core_.step(now); }
  void restart() override { core_.restart(); }
  [[nodiscard]] Level level() const override { return core_.level(); }
  bool may_drive(std::int64_t now) override { return core_.may_drive(now); }
  [[nodiscard]] float speed_limit() const override { return core_.speed_limit(); }
  std::size_t objects(Object* to, std::size_t most) const override { return core_.objects(to, most); }
  std::size_t outline(std::uint32_t id, Point* to, std::size_t most) const override {
    return core_.outline(id, to, most);
  }
  std::size_t sectors(float* to, std::size_t most) const override { return core_.sectors(to, most); }
  std::size_t ways(fencepost_way* to, std::size_t most, const fencepost_passing_rule* rules,
                   std::size_t count) const override {
    return core_.ways(to, most, rules, count);
  }
  bool pose(Pose& to) const override { return core_.pose(to); }
  [[nodiscard]] std::uint64_t digest() const override { return core_.digest(); }

 private:
  Core<Size> core_;
};

/// All that knows this size: a program that does not ask for it need not link it.
template <class Size>
inline constexpr fencepost_capacity kCapacity{
    sizeof(SizedCore<Size>), Size::kObjects,
    [](void* memory) -> fencepost_core* { return std::construct_at(static_cast<SizedCore<Size>*>(memory)); }};

}  // namespace fencepost::library
