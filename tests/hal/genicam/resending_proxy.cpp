// SPDX-License-Identifier: Apache-2.0
#include "tests/hal/genicam/resending_proxy.h"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>

#include <stdexcept>
#include <utility>

namespace orbwatch::tests {
namespace {

// GigE Vision's control protocol; registers of stream channel 0 and of capabilities.
constexpr std::uint16_t kPort = 3956;
constexpr std::uint32_t kPacketResend = 0x40;
constexpr std::uint32_t kReadRegister = 0x80;
constexpr std::uint32_t kReadRegisterAnswer = 0x81;
constexpr std::uint32_t kWriteRegister = 0x82;
constexpr std::uint32_t kWriteMemory = 0x86;
constexpr std::uint32_t kCapabilities = 0x0934;
constexpr std::uint32_t kResends = 4;  // bit of the capabilities
constexpr std::uint32_t kStreamPort = 0x0d00;
constexpr std::uint32_t kStreamAddress = 0x0d18;
constexpr std::size_t kHeader = 8;

/// Frames whose packets are kept.
constexpr std::uint16_t kFrames = 16;

std::uint32_t take(std::span<const std::byte> bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + size; ++i) {
    value = value << 8 | std::to_integer<std::uint32_t>(bytes[i]);
  }
  return value;
}

/// Camera's stamp in the first packet of a frame.
std::uint64_t stamp_of(std::span<const std::byte> packet) {
  constexpr std::size_t kStamp = kHeader + 4;
  return std::uint64_t{take(packet, kStamp, 4)} << 32 | take(packet, kStamp + 4, 4);
}

void put(std::span<std::byte> bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::byte>(value >> (24 - 8 * i));
}

sockaddr_in address_of(const std::string& address, std::uint16_t port) {
  sockaddr_in result{};
  result.sin_family = AF_INET;
  result.sin_port = htons(port);
  ::inet_pton(AF_INET, address.c_str(), &result.sin_addr);
  return result;
}

const sockaddr* generic(const sockaddr_in& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}

hal::FileDescriptor bound_socket(const sockaddr_in& address) {
  hal::FileDescriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (::bind(socket.get(), generic(address), sizeof(address)) != 0) {
    throw std::runtime_error("the proxy cannot listen");
  }
  return socket;
}

}  // namespace

ResendingProxy::ResendingProxy(const std::string& address, double lost_per_thousand,
                               LosesFirst loses_first)
    : loses_(lost_per_thousand / 1000),
      loses_first_(std::move(loses_first)),
      control_(bound_socket(address_of(address, kPort))),
      upstream_(bound_socket(address_of("127.0.0.1", 0))),
      stream_(bound_socket(address_of("0.0.0.0", 0))) {
  const sockaddr_in camera = address_of("127.0.0.1", kPort);
  if (::connect(upstream_.get(), generic(camera), sizeof(camera)) != 0) {
    throw std::runtime_error("the proxy finds no camera");
  }
  // The camera sends all packets of a frame at once.
  constexpr int kFrameBytes = 1 << 20;
  ::setsockopt(stream_.get(), SOL_SOCKET, SO_RCVBUFFORCE, &kFrameBytes, sizeof(kFrameBytes));
  sockaddr_in own{};
  socklen_t size = sizeof(own);
  ::getsockname(stream_.get(), reinterpret_cast<sockaddr*>(&own), &size);
  stream_port_ = ntohs(own.sin_port);
  sink_.sin_family = AF_INET;
  thread_ = std::thread([this] { serve(); });
}

ResendingProxy::~ResendingProxy() {
  end_.signal();
  thread_.join();
}

void ResendingProxy::serve() {
  std::array<std::byte, 16384> buffer{};
  std::array<pollfd, 4> files{{{end_.get(), POLLIN, 0},
                               {control_.get(), POLLIN, 0},
                               {upstream_.get(), POLLIN, 0},
                               {stream_.get(), POLLIN, 0}}};
  while (::poll(files.data(), files.size(), -1) > 0 && files[0].revents == 0) {
    for (std::size_t i = 1; i < files.size(); ++i) {
      if (files[i].revents == 0) continue;
      sockaddr_in sender{};
      socklen_t size = sizeof(sender);
      const ssize_t count = ::recvfrom(files[i].fd, buffer.data(), buffer.size(), 0,
                                       reinterpret_cast<sockaddr*>(&sender), &size);
      if (count < static_cast<ssize_t>(kHeader)) continue;
      const Bytes packet(buffer.data(), static_cast<std::size_t>(count));
      if (i == 1) on_request(packet, sender);
      if (i == 2) on_answer(packet);
      if (i == 3) on_stream(packet);
    }
  }
}

void ResendingProxy::on_request(Bytes packet, const sockaddr_in& client) {
  const std::uint32_t command = take(packet, 2, 2);
  if (command == kPacketResend) return resend(packet);
  client_ = client;
  asked_capabilities_ = command == kReadRegister && take(packet, kHeader, 4) == kCapabilities;
  if (command == kWriteRegister || command == kWriteMemory) {
    redirect(take(packet, kHeader, 4), packet.subspan(kHeader + 4, 4));
  }
  ::send(upstream_.get(), packet.data(), packet.size(), 0);
}

/// Redirects the stream: the proxy sends it to the destination that the client sets, and the camera
/// sends it to the proxy.
void ResendingProxy::redirect(std::uint32_t address, Bytes value) {
  const std::uint32_t wanted = take(value, 0, 4);
  if (wanted == 0) return;  // end of the stream
  if (address == kStreamPort) {
    sink_.sin_port = htons(static_cast<std::uint16_t>(wanted));
    put(value, 0, (wanted & 0xffff0000U) | stream_port_);
  } else if (address == kStreamAddress) {
    sink_.sin_addr.s_addr = htonl(wanted);
    put(value, 0, INADDR_LOOPBACK);
  }
}

void ResendingProxy::on_answer(Bytes packet) {
  if (asked_capabilities_ && take(packet, 2, 2) == kReadRegisterAnswer) {
    put(packet, kHeader, take(packet, kHeader, 4) | kResends);
  }
  ::sendto(control_.get(), packet.data(), packet.size(), 0, generic(client_), sizeof(client_));
}

void ResendingProxy::on_stream(Bytes packet) {
  const auto frame = static_cast<std::uint16_t>(take(packet, 2, 2));
  const std::uint32_t id = take(packet, 5, 3);
  if (id == 0) {
    std::erase_if(kept_, [frame](const auto& kept) {
      return static_cast<std::uint16_t>(frame - kept.first.first) > kFrames;
    });
    if (loses_first_ && loses_first_(stamp_of(packet))) return;
  }
  kept_[{frame, id}] = {packet.begin(), packet.end()};
  if (send_or_lose(packet) || last_injured_ == frame) return;
  last_injured_ = frame;
  ++injured_;
}

void ResendingProxy::resend(Bytes request) {
  const auto frame = static_cast<std::uint16_t>(take(request, kHeader + 2, 2));
  const std::uint32_t last = take(request, kHeader + 9, 3);
  for (std::uint32_t id = take(request, kHeader + 5, 3); id <= last; ++id) {
    const auto kept = kept_.find({frame, id});
    if (kept != kept_.end()) send_or_lose(kept->second);
  }
}

/// False: the packet is lost.
bool ResendingProxy::send_or_lose(std::span<const std::byte> packet) {
  if (loses_(random_)) return false;
  ::sendto(stream_.get(), packet.data(), packet.size(), 0, generic(sink_), sizeof(sink_));
  return true;
}

}  // namespace orbwatch::tests
