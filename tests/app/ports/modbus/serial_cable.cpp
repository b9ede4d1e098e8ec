// SPDX-License-Identifier: Apache-2.0
#include "tests/app/ports/modbus/serial_cable.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <termios.h>

#include <cerrno>
#include <cstdlib>
#include <span>

#include "tests/support/require.h"

namespace orbwatch::app::tests {
namespace {

using orbwatch::tests::require;

constexpr std::chrono::milliseconds kCableGuard = std::chrono::minutes(1);

/// Disables echo and translation.
void make_raw(int terminal) {
  termios settings{};
  require(::tcgetattr(terminal, &settings) == 0);
  ::cfmakeraw(&settings);
  require(::tcsetattr(terminal, TCSANOW, &settings) == 0);
}

/// Waits until the file can be read or written; false: not in time.
bool wait_for(int file, short what, std::chrono::milliseconds longest = kCableGuard) {
  pollfd wait{file, what, 0};
  return ::poll(&wait, 1, static_cast<int>(longest.count())) > 0;
}

void write_all(int file, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    require(wait_for(file, POLLOUT));
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    require(written >= 0 || errno == EAGAIN);
    if (written > 0) bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

}  // namespace

SerialCable::SerialCable() : stop_(::eventfd(0, EFD_CLOEXEC)) {
  require(stop_.is_open());
  plug_in();
}

SerialCable::~SerialCable() { stop_carrying(); }

void SerialCable::plug_in() {
  const std::array paths{device(), master()};
  for (std::size_t i = 0; i < 2; ++i) {
    ports_[i] = hal::FileDescriptor(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC));
    std::array<char, 64> name{};
    require(ports_[i].is_open() && ::grantpt(ports_[i].get()) == 0 &&
            ::unlockpt(ports_[i].get()) == 0 &&
            ::ptsname_r(ports_[i].get(), name.data(), name.size()) == 0);
    ends_[i] = hal::FileDescriptor(::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC));
    require(ends_[i].is_open());
    make_raw(ends_[i].get());
    std::filesystem::create_symlink(name.data(), paths[i]);
  }
  carrier_ = std::thread([this] { carry(); });
}

void SerialCable::unplug() {
  stop_carrying();
  std::filesystem::remove(device());
  std::filesystem::remove(master());
  for (auto& port : ports_) hal::FileDescriptor(std::move(port));
  for (auto& end : ends_) hal::FileDescriptor(std::move(end));
}

void SerialCable::stop_carrying() {
  if (!carrier_.joinable()) return;
  // Cannot fail: the counter has no other writer.
  ::eventfd_write(stop_.get(), 1);
  carrier_.join();
  eventfd_t told = 0;
  ::eventfd_read(stop_.get(), &told);
}

void SerialCable::carry() {
  std::array<std::uint8_t, 256> bytes;
  for (;;) {
    std::array<pollfd, 3> files{
        {{ports_[0].get(), POLLIN, 0}, {ports_[1].get(), POLLIN, 0}, {stop_.get(), POLLIN, 0}}};
    require(::poll(files.data(), files.size(), -1) > 0);
    if (files[2].revents != 0) return;
    for (std::size_t from = 0; from < 2; ++from) {
      if (files[from].revents == 0) continue;
      const ssize_t count = ::read(ports_[from].get(), bytes.data(), bytes.size());
      require(count > 0);
      // Bytes that are not read in time are lost, like on a wire.
      pollfd to{ports_[1 - from].get(), POLLOUT, 0};
      if (::poll(&to, 1, 0) <= 0) continue;
      require(::write(to.fd, bytes.data(), static_cast<std::size_t>(count)) > 0);
    }
  }
}

RawMaster::RawMaster(const std::string& path)
    : port_(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
  require(port_.is_open());
}

void RawMaster::send(const Bytes& bytes) { write_all(port_.get(), bytes); }

Bytes RawMaster::receive(std::size_t count, std::chrono::milliseconds longest) {
  Bytes bytes(count);
  std::size_t got = 0;
  while (got < count && wait_for(port_.get(), POLLIN, longest)) {
    const ssize_t received = ::read(port_.get(), bytes.data() + got, count - got);
    if (received <= 0) break;
    got += static_cast<std::size_t>(received);
  }
  bytes.resize(got);
  return bytes;
}

}  // namespace orbwatch::app::tests
