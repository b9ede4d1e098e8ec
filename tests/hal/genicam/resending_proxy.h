// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <netinet/in.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "hal/thread/file_descriptor.h"

namespace orbwatch::tests {

/// Proxy in front of Aravis' fake camera, which listens on the loopback interface and does not
/// resend packets: keeps the packets of its stream, loses some on their way, and resends them on
/// request (GigE Vision's PACKETRESEND), where they may be lost once more. Lives in the network of
/// the thread that makes it.
class ResendingProxy {
 public:
  /// Called on the proxy's thread with the camera's stamp of each frame, in ns. True: the frame's
  /// first packet is lost, and not resent.
  using LosesFirst = std::function<bool(std::uint64_t stamp)>;

  /// Listens at `address`; loses `lost_per_thousand` of a thousand packets, and more by
  /// `loses_first`.
  ResendingProxy(const std::string& address, double lost_per_thousand, LosesFirst loses_first = {});
  ResendingProxy(const ResendingProxy&) = delete;
  ResendingProxy& operator=(const ResendingProxy&) = delete;
  ~ResendingProxy();

  /// Frames of which at least one packet was lost at first.
  int injured() const { return injured_; }

 private:
  using Bytes = std::span<std::byte>;
  using PacketId =
      std::pair<std::uint16_t, std::uint32_t>;  ///< number of a frame, and of a packet in it

  void serve();
  void on_request(Bytes packet, const sockaddr_in& client);
  void on_answer(Bytes packet);
  void on_stream(Bytes packet);
  void redirect(std::uint32_t address, Bytes value);
  void resend(Bytes request);
  bool send_or_lose(std::span<const std::byte> packet);

  std::bernoulli_distribution loses_;
  LosesFirst loses_first_;
  std::mt19937 random_{11};
  hal::FileDescriptor control_;   ///< socket to the client
  hal::FileDescriptor upstream_;  ///< socket to the camera
  hal::FileDescriptor stream_;    ///< socket from the camera, and to the client
  std::uint16_t stream_port_ = 0;
  sockaddr_in client_{};  ///< client that sent the last request
  sockaddr_in sink_{};    ///< destination of the stream that the client set
  bool asked_capabilities_ = false;
  std::map<PacketId, std::vector<std::byte>> kept_;
  std::optional<std::uint16_t> last_injured_;  ///< number of a frame
  std::atomic<int> injured_ = 0;
  hal::EventFd end_;
  std::thread thread_;
};

}  // namespace orbwatch::tests
