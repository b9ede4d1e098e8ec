// SPDX-License-Identifier: Apache-2.0
#include "tests/hal/v4l2/fake_device.h"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstring>
#include <ctime>
#include <deque>
#include <mutex>
#include <set>
#include <tuple>

namespace orbwatch::tests {
namespace {

constexpr std::size_t kMostBuffers = 8;
constexpr std::size_t kLargestBuffer = std::size_t{1} << 20;
constexpr std::uint32_t kTriggerMode = V4L2_CID_USER_BASE + 0x1000;  // a control of a driver's own

/// The device and its only stream.
struct State {
  std::mutex mutex;
  FakeDevice device;
  std::set<int> files;
  std::uint32_t width = 0, height = 0;
  std::array<void*, kMostBuffers> memory{};
  std::deque<std::uint32_t> queued;
  bool streams = false;
  std::uint32_t sequence = 0;

  std::uint32_t bytes() const { return 2 * width * height; }
};

State& state() {
  static State only;
  return only;
}

template <class T>
T& as(void* argument) {
  return *static_cast<T*>(argument);
}

int refuse(int error) {
  errno = error;
  return -1;
}

int query_capability(v4l2_capability& capability) {
  std::memcpy(capability.driver, "fake", 5);
  std::memcpy(capability.card, "Fake Thermal", 13);
  std::memcpy(capability.bus_info, "usb-fake-1", 11);
  capability.device_caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  capability.capabilities = capability.device_caps | V4L2_CAP_DEVICE_CAPS;
  return 0;
}

int list_size(const State& fake, v4l2_frmsizeenum& size) {
  if (size.pixel_format != fake.device.fourcc || size.index >= fake.device.sizes.size()) {
    return refuse(EINVAL);
  }
  size.type = V4L2_FRMSIZE_TYPE_DISCRETE;
  std::tie(size.discrete.width, size.discrete.height) = fake.device.sizes[size.index];
  return 0;
}

/// Behaves like drivers: sets a size that it has, and keeps the current one for any other.
int set_format(State& fake, v4l2_format& format, bool sets) {
  v4l2_pix_format& pix = format.fmt.pix;
  const std::pair wanted{pix.width, pix.height};
  if (sets && std::ranges::find(fake.device.sizes, wanted) != fake.device.sizes.end()) {
    std::tie(fake.width, fake.height) = wanted;
  }
  pix.width = fake.width;
  pix.height = fake.height;
  pix.pixelformat = fake.device.fourcc;
  pix.field = V4L2_FIELD_NONE;
  pix.bytesperline = 2 * fake.width;
  pix.sizeimage = fake.bytes();
  pix.colorspace = V4L2_COLORSPACE_SRGB;
  return 0;
}

/// Describes the only control to a query for the one after an id.
int query_control(const State& fake, v4l2_query_ext_ctrl& control) {
  if (!fake.device.trigger_mode) return refuse(EINVAL);
  if ((control.id & ~V4L2_CTRL_FLAG_NEXT_CTRL) >= kTriggerMode) return refuse(EINVAL);
  control.id = kTriggerMode;
  control.type = V4L2_CTRL_TYPE_BOOLEAN;
  control.maximum = 1;
  std::memcpy(control.name, "Trigger Mode", 13);
  return 0;
}

int request_buffers(State& fake, v4l2_requestbuffers& request) {
  if (request.memory != V4L2_MEMORY_MMAP) return refuse(EINVAL);
  request.count = std::min<std::uint32_t>(request.count, kMostBuffers);
  request.capabilities = V4L2_BUF_CAP_SUPPORTS_MMAP;
  fake.queued.clear();
  return 0;
}

/// Fills the buffer; returns the bytes of the frame.
std::uint32_t fill(const State& fake, void* buffer) {
  if (fake.device.draw != nullptr) {
    fake.device.draw({static_cast<std::uint16_t*>(buffer), fake.bytes() / 2}, fake.width);
    return fake.bytes();
  }
  std::memcpy(buffer, fake.device.jpeg.data(), fake.device.jpeg.size());
  return static_cast<std::uint32_t>(fake.device.jpeg.size());
}

int dequeue(State& fake, int file, v4l2_buffer& buffer) {
  std::uint64_t ticks = 0;
  if (!fake.streams || ::read(file, &ticks, sizeof ticks) != sizeof ticks || fake.queued.empty()) {
    return refuse(EAGAIN);
  }
  if (fake.device.trigger_mode.value_or(0) != 0) return refuse(EAGAIN);
  const std::uint32_t index = fake.queued.front();
  fake.queued.pop_front();
  const std::uint32_t size = fill(fake, fake.memory[index]);
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  buffer.index = index;
  buffer.bytesused = size;
  buffer.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  buffer.timestamp = {now.tv_sec, now.tv_nsec / 1000};
  buffer.sequence = fake.sequence++;
  return 0;
}

int answer(State& fake, int file, unsigned long code, void* argument) {
  switch (code) {
    case VIDIOC_QUERYCAP:
      return query_capability(as<v4l2_capability>(argument));
    case VIDIOC_ENUM_FMT:
      as<v4l2_fmtdesc>(argument).pixelformat = fake.device.fourcc;
      return as<v4l2_fmtdesc>(argument).index == 0 ? 0 : refuse(EINVAL);
    case VIDIOC_ENUM_FRAMESIZES:
      return list_size(fake, as<v4l2_frmsizeenum>(argument));
    case VIDIOC_S_FMT:
      return set_format(fake, as<v4l2_format>(argument), true);
    case VIDIOC_G_FMT:
      return set_format(fake, as<v4l2_format>(argument), false);
    case VIDIOC_QUERY_EXT_CTRL:
      return query_control(fake, as<v4l2_query_ext_ctrl>(argument));
    case VIDIOC_G_EXT_CTRLS:
      as<v4l2_ext_controls>(argument).controls->value = fake.device.trigger_mode.value_or(0);
      return 0;
    case VIDIOC_S_EXT_CTRLS:
      fake.device.trigger_mode = std::int32_t{as<v4l2_ext_controls>(argument).controls->value};
      return 0;
    case VIDIOC_REQBUFS:
      return request_buffers(fake, as<v4l2_requestbuffers>(argument));
    case VIDIOC_QUERYBUF:
      as<v4l2_buffer>(argument).length = fake.bytes();
      as<v4l2_buffer>(argument).m.offset =
          as<v4l2_buffer>(argument).index * static_cast<std::uint32_t>(kLargestBuffer);
      return 0;
    case VIDIOC_QBUF:
      fake.queued.push_back(as<v4l2_buffer>(argument).index);
      return 0;
    case VIDIOC_DQBUF:
      return dequeue(fake, file, as<v4l2_buffer>(argument));
    case VIDIOC_STREAMON:
    case VIDIOC_STREAMOFF:
      fake.streams = code == VIDIOC_STREAMON;
      return 0;
    default:
      return refuse(code == VIDIOC_ENUM_FRAMEINTERVALS ? EINVAL : ENOTTY);
  }
}

/// Uses a timer, so that poll() reports the next frame.
int open_fake(State& fake) {
  constexpr itimerspec kPeriod{{0, 10'000'000}, {0, 10'000'000}};
  const int file = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
  timerfd_settime(file, 0, &kPeriod, nullptr);
  fake.files.insert(file);
  return file;
}

bool is_fake(int file) {
  const std::lock_guard lock(state().mutex);
  return state().files.contains(file);
}

}  // namespace

void connect(const FakeDevice& device) {
  State& fake = state();
  const std::lock_guard lock(fake.mutex);
  fake.device = device;
  std::tie(fake.width, fake.height) = device.sizes.front();
}

std::optional<std::int32_t> trigger_mode() {
  const std::lock_guard lock(state().mutex);
  return state().device.trigger_mode;
}

}  // namespace orbwatch::tests

using orbwatch::tests::state;

extern "C" {

int open(const char* path, int flags, ...) {
  std::va_list rest;
  va_start(rest, flags);
  const int mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, int) : 0;
  va_end(rest);
  if (std::strcmp(path, orbwatch::tests::kFakeDevice) != 0) {
    return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
  }
  const std::lock_guard lock(state().mutex);
  return orbwatch::tests::open_fake(state());
}

int close(int file) {
  const std::lock_guard lock(state().mutex);
  state().files.erase(file);
  return static_cast<int>(syscall(SYS_close, file));
}

int ioctl(int file, unsigned long code, ...) noexcept {
  std::va_list rest;
  va_start(rest, code);
  void* const argument = va_arg(rest, void*);
  va_end(rest);
  if (!orbwatch::tests::is_fake(file)) {
    return static_cast<int>(syscall(SYS_ioctl, file, code, argument));
  }
  const std::lock_guard lock(state().mutex);
  return orbwatch::tests::answer(state(), file, code, argument);
}

void* mmap(void* address, std::size_t length, int protection, int flags, int file,
           off_t offset) noexcept {
  if (!orbwatch::tests::is_fake(file)) {
    return reinterpret_cast<void*>(
        syscall(SYS_mmap, address, length, protection, flags, file, offset));
  }
  void* const memory = reinterpret_cast<void*>(
      syscall(SYS_mmap, nullptr, length, protection, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  state().memory[static_cast<std::size_t>(offset) / orbwatch::tests::kLargestBuffer] = memory;
  return memory;
}

}  // extern "C"
