// SPDX-License-Identifier: Apache-2.0
#include "hal/genicam/device/gige_identity.h"

#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <chrono>

#include "hal/clock.h"
#include "hal/socket_address.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::hal {
namespace {

using namespace std::chrono_literals;

// The control protocol (GVCP) of GigE Vision 1.2, chapters 16 and 28: big-endian.
constexpr std::uint16_t kPort = 3956;
constexpr std::byte kKey{0x42};
constexpr std::byte kAnswerRequired{0x01};
constexpr std::uint16_t kReadMemory = 0x0084;
constexpr std::uint16_t kReadMemoryAnswer = 0x0085;
constexpr std::size_t kHeader = 8;

struct Register {
  std::uint32_t address;
  std::size_t size;
};
constexpr Register kModel{0x0068, 32};
constexpr Register kSerial{0x00d8, 16};
constexpr Register kUserDefinedName{0x00e8, 16};

constexpr int kAttempts = 3;
constexpr auto kPatience = 150ms;

template <std::size_t kSize>
void put(std::array<std::byte, kSize>& bytes, std::size_t at, std::uint32_t value, int size) {
  for (int i = 0; i < size; ++i) {
    bytes[at + static_cast<std::size_t>(i)] = static_cast<std::byte>(value >> 8 * (size - 1 - i));
  }
}

std::uint32_t take(std::span<const std::byte> bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
  }
  return value;
}

std::array<std::byte, 16> read_memory_request(std::uint16_t id, const Register& wanted) {
  std::array<std::byte, 16> packet{kKey, kAnswerRequired};
  put(packet, 2, kReadMemory, 2);
  put(packet, 4, packet.size() - kHeader, 2);
  put(packet, 6, id, 2);
  put(packet, 8, wanted.address, 4);
  put(packet, 14, static_cast<std::uint32_t>(wanted.size), 2);
  return packet;
}

/// Receives the answer until `deadline`.
std::optional<std::string> receive(const FileDescriptor& socket, std::uint16_t id,
                                   const Register& wanted, TimePoint deadline) {
  while (Clock::now() < deadline) {
    pollfd file{socket.get(), POLLIN, 0};
    if (::poll(&file, 1, poll_timeout(deadline)) <= 0) continue;
    std::array<std::byte, 576> answer;
    const ssize_t size = ::recv(socket.get(), answer.data(), answer.size(), 0);
    if (size < 0) return std::nullopt;  // nothing listens there
    auto memory = memory_in_answer({answer.data(), static_cast<std::size_t>(size)}, id,
                                   wanted.address, wanted.size);
    if (memory) return memory;
  }
  return std::nullopt;
}

std::optional<std::string> read_text(const FileDescriptor& socket, std::uint16_t id,
                                     const Register& wanted) {
  const auto request = read_memory_request(id, wanted);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (::send(socket.get(), request.data(), request.size(), MSG_NOSIGNAL) < 0) continue;
    const auto memory = receive(socket, id, wanted, Clock::now() + kPatience);
    if (memory) return memory->substr(0, memory->find('\0'));
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> memory_in_answer(std::span<const std::byte> answer,
                                            std::uint16_t request_id, std::uint32_t address,
                                            std::size_t size) {
  constexpr std::size_t kFront = kHeader + sizeof(address);
  if (answer.size() < kFront + size) return std::nullopt;
  const bool is_answer = take(answer, 0, 2) == 0 && take(answer, 2, 2) == kReadMemoryAnswer &&
                         take(answer, 6, 2) == request_id && take(answer, 8, 4) == address;
  if (!is_answer) return std::nullopt;
  const auto data = answer.subspan(kFront, size);
  return std::string(reinterpret_cast<const char*>(data.data()), data.size());
}

bool is_ip_address(const std::string& text) {
  const auto host = parse_host(text);
  return host && is_v4(*host);
}

std::optional<GigeIdentity> read_gige_identity(const std::string& address) {
  const auto camera = parse_address(address, kPort);
  if (!camera || camera->family() != AF_INET) return std::nullopt;
  const FileDescriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (::connect(socket.get(), camera->get(), camera->length) != 0) return std::nullopt;
  // An absent camera costs the timeout of only one register.
  const auto serial = read_text(socket, 1, kSerial);
  if (!serial) return std::nullopt;
  return GigeIdentity{read_text(socket, 2, kModel).value_or(""), *serial,
                      read_text(socket, 3, kUserDefinedName).value_or("")};
}

}  // namespace orbwatch::hal
