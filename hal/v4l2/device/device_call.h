#pragma once

#include <sys/ioctl.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>

#include "hal/fault.h"
#include "hal/thread/file_descriptor.h"

/// Shared by all calls to a V4L2 device. For the files of V4l2Device only.
namespace orbwatch::hal {

/// More entries than any camera lists; bounds the enumeration with a broken driver.
inline constexpr std::uint32_t kMaxEntries = 256;

/// One ioctl, repeated when a signal interrupts it: 0, or the error number.
template <class T>
int call(const FileDescriptor& file, unsigned long request, T& argument) {
  for (;;) {
    if (::ioctl(file.get(), request, &argument) == 0) return 0;
    if (errno != EINTR) return errno;
  }
}

/// Unused members of V4L2's structures must be zero.
template <class T>
T cleared() {
  T value;
  std::memset(&value, 0, sizeof(value));
  return value;
}

/// The text of a structure's field, which need not be zero-terminated.
template <class Byte, std::size_t N>
std::string text_of(const Byte (&field)[N]) {
  const auto* text = reinterpret_cast<const char*>(field);
  return {text, ::strnlen(text, N)};
}

/// The fault that a failed call means.
inline Fault fault_of(int error) {
  return error == ENOENT || error == ENODEV || error == ENXIO ? Fault::Unplugged : Fault::ReadError;
}

}  // namespace orbwatch::hal
