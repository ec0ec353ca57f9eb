#include "hal/linux/v4l2.hpp"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <utility>

namespace fencepost::linux {
namespace {

constexpr std::string_view kOpenCamera = "open the camera";
/// One is read, one is written, and two wait for a loop that is late.
constexpr std::uint32_t kBuffers = 4;
constexpr std::int64_t kMicroseconds = 1'000'000;  // of a second

std::string_view camera_remedy(int error) {
  switch (error) {
    case ENOENT:
    case ENXIO:
    case ENODEV: return "plug it in; 'v4l2-ctl --list-devices' lists what is there";
    case EACCES:
    case EPERM: return "add yourself to its group with 'sudo usermod -aG video $USER' and log in again";
    case EBUSY: return "another program has it: end that first";
    case ENOTTY:
    case EINVAL: return "name a camera that can capture, such as /dev/video0; its other nodes cannot";
    default: return "look at the end of 'dmesg'";
  }
}

Problem camera_problem(const std::string& path, int error) {
  return failure(kOpenCamera, path, error, camera_remedy(error));
}

/// 0, or an errno.
template <class Argument>
int ask(int fd, unsigned long request, Argument& argument) {
  int answer = 0;
  do {
    answer = ::ioctl(fd, request, &argument);
  } while (answer < 0 && errno == EINTR);
  return answer < 0 ? errno : 0;
}

std::uint32_t code_of(PictureCoding coding) {
  return coding == PictureCoding::kJpeg ? V4L2_PIX_FMT_MJPEG : V4L2_PIX_FMT_YUYV;
}

v4l2_buffer mapped_buffer(std::uint32_t index) {
  v4l2_buffer buffer{};
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = index;
  return buffer;
}

/// 0, or an errno: whether it captures, by streaming.
int check_abilities(int fd) {
  v4l2_capability can{};
  if (const int error = ask(fd, VIDIOC_QUERYCAP, can); error != 0) return error;
  const std::uint32_t abilities = (can.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? can.device_caps : can.capabilities;
  constexpr std::uint32_t kNeeded = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  return (abilities & kNeeded) == kNeeded ? 0 : EINVAL;
}

/// The format that the camera sets when it is asked for this one; it may be another.
v4l2_pix_format set_format(int fd, const V4l2Settings& settings, PictureCoding coding) {
  v4l2_format format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  format.fmt.pix.width = settings.width;
  format.fmt.pix.height = settings.height;
  format.fmt.pix.pixelformat = code_of(coding);
  format.fmt.pix.field = V4L2_FIELD_ANY;
  return ask(fd, VIDIOC_S_FMT, format) == 0 ? format.fmt.pix : v4l2_pix_format{};
}

/// Many cameras have one rate only; what they refuse is no fault.
void set_rate(int fd, std::uint32_t rate) {
  v4l2_streamparm parameters{};
  parameters.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  parameters.parm.capture.timeperframe = {1, rate};
  static_cast<void>(ask(fd, VIDIOC_S_PARM, parameters));
}

std::int64_t monotonic_us() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::int64_t>(now.tv_sec) * kMicroseconds + now.tv_nsec / 1'000;
}

}  // namespace

Opened<V4l2> V4l2::open(V4l2Settings settings) {
  V4l2 camera(std::move(settings));
  Opened<Descriptor> started = camera.start();
  if (!started) return Problem{started.problem()};
  camera.fd_ = std::move(*started);
  return camera;
}

V4l2::~V4l2() { close(); }

V4l2& V4l2::operator=(V4l2&& other) noexcept {
  if (this == &other) return *this;
  close();
  settings_ = std::move(other.settings_);
  fd_ = std::move(other.fd_);
  coding_ = other.coding_;
  stride_ = other.stride_;
  buffers_ = std::move(other.buffers_);
  held_ = std::exchange(other.held_, -1);
  now_ = other.now_;
  now_us_ = other.now_us_;
  retry_ = other.retry_;
  problem_ = std::move(other.problem_);
  return *this;
}

/// On failure nothing stays mapped.
Opened<Descriptor> V4l2::start() {
  Descriptor fd(::open(settings_.path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC));
  if (!fd.open()) return camera_problem(settings_.path, errno == EISDIR ? ENOTTY : errno);
  if (const int error = check_abilities(fd.get()); error != 0) return camera_problem(settings_.path, error);
  v4l2_pix_format format{};
  for (const PictureCoding coding : settings_.codings) {
    format = set_format(fd.get(), settings_, coding);
    coding_ = coding;
    if (format.pixelformat == code_of(coding) && format.width == settings_.width && format.height == settings_.height)
      break;
    format = {};
  }
  const std::string size = std::to_string(settings_.width) + " x " + std::to_string(settings_.height);
  if (format.width == 0) {
    return Problem{"the camera " + settings_.path + " has no pictures of " + size +
                   " px; 'v4l2-ctl --list-formats-ext -d " + settings_.path + "' lists what it has"};
  }
  stride_ = coding_ == PictureCoding::kJpeg ? 0 : std::max(format.bytesperline, 2U * settings_.width);
  set_rate(fd.get(), settings_.rate);
  int error = map(fd.get());
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (error == 0) error = ask(fd.get(), VIDIOC_STREAMON, type);
  if (error == 0) return fd;
  close();
  return camera_problem(settings_.path, error);
}

/// 0, or an errno.
int V4l2::map(int fd) {
  v4l2_requestbuffers wanted{};
  wanted.count = kBuffers;
  wanted.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  wanted.memory = V4L2_MEMORY_MMAP;
  if (const int error = ask(fd, VIDIOC_REQBUFS, wanted); error != 0) return error;
  for (std::uint32_t i = 0; i < wanted.count; ++i) {
    v4l2_buffer buffer = mapped_buffer(i);
    if (const int error = ask(fd, VIDIOC_QUERYBUF, buffer); error != 0) return error;
    void* const bytes =
        ::mmap(nullptr, buffer.length, PROT_READ | PROT_WRITE, MAP_SHARED, fd, static_cast<off_t>(buffer.m.offset));
    if (bytes == MAP_FAILED) return errno;  // NOLINT(cppcoreguidelines-pro-type-cstyle-cast): a macro
    buffers_.emplace_back(static_cast<std::uint8_t*>(bytes), buffer.length);
    if (const int error = ask(fd, VIDIOC_QBUF, buffer); error != 0) return error;
  }
  return buffers_.empty() ? ENOMEM : 0;
}

void V4l2::close() {
  fd_.close();  // ends the stream
  for (const std::span<std::uint8_t> buffer : buffers_) ::munmap(buffer.data(), buffer.size());
  buffers_.clear();
  held_ = -1;
}

bool V4l2::queue(std::uint32_t index) {
  v4l2_buffer buffer = mapped_buffer(index);
  return ask(fd_.get(), VIDIOC_QBUF, buffer) == 0;
}

void V4l2::give_back() {
  if (const int held = std::exchange(held_, -1); held >= 0) static_cast<void>(queue(static_cast<std::uint32_t>(held)));
}

base::Result<CodedPicture> V4l2::next() {
  if (!fd_.open()) return base::Error::kGone;
  v4l2_buffer newest{};
  bool any = false;
  // No more than there are buffers, or a fast camera would keep a slow loop here.
  for (std::uint32_t i = 0; i < kBuffers; ++i) {
    v4l2_buffer buffer = mapped_buffer(0);
    const int error = ask(fd_.get(), VIDIOC_DQBUF, buffer);
    if (error == EAGAIN) break;
    if (error != 0 || buffer.index >= buffers_.size()) {
      close();
      return base::Error::kGone;
    }
    give_back();
    held_ = static_cast<int>(buffer.index);
    newest = buffer;
    any = true;
  }
  if (!any) return base::Error::kNotReady;
  if ((newest.flags & V4L2_BUF_FLAG_ERROR) != 0) return base::Error::kBadInput;
  const std::span<const std::uint8_t> bytes = buffers_[newest.index];
  const std::int64_t stamp =
      static_cast<std::int64_t>(newest.timestamp.tv_sec) * kMicroseconds + newest.timestamp.tv_usec;
  const bool monotonic = (newest.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  return CodedPicture{coding_,
                      settings_.width,
                      settings_.height,
                      stride_,
                      bytes.first(std::min<std::size_t>(newest.bytesused, bytes.size())),
                      monotonic ? on_our_clock(stamp) : now_};
}

/// Not after now: a picture that arrived since `tend` is of now.
base::Time V4l2::on_our_clock(std::int64_t stamp_us) const {
  const std::int64_t age = std::clamp(now_us_ - stamp_us, std::int64_t{0}, kMicroseconds);
  return now_ - base::Duration{age * base::Duration::kPerUnit / kMicroseconds};
}

void V4l2::tend(base::Time now) {
  now_ = now;
  now_us_ = monotonic_us();
  if (fd_.open() || !retry_.due(now)) return;
  Opened<Descriptor> started = start();
  problem_ = started ? std::string() : started.problem();
  if (started) fd_ = std::move(*started);
}

}  // namespace fencepost::linux
