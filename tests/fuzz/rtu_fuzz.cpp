// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <chrono>
#include <vector>

#include "app/ports/modbus/server/rtu_framer.h"
#include "tests/fuzz/byte_stream.h"
#include "tests/fuzz/stop.h"

/// Anything on a serial line, with any pauses: all frames found are frames that were sent, for this
/// unit and with a right checksum, and after silence the next request is found.
///
/// An input is pieces: a byte of bits (see Piece), a length, and that number of bytes.
namespace orbwatch::fuzz {
namespace {

using app::modbus::RtuFramer;
using std::chrono::milliseconds;
using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kUnit = 1;

/// Two bits for the silence before it, and one that adds a right checksum, which chance would
/// hardly find.
enum Piece : std::uint8_t { kSilence = 3, kIsChecked = 4 };
constexpr std::array kSilences{milliseconds(0), milliseconds(2), milliseconds(16),
                               milliseconds(1000)};

/// Modbus over Serial Line V1.02, 6.2.2.
std::uint16_t checksum_of(std::span<const std::uint8_t> bytes) {
  unsigned checksum = 0xffff;
  for (const unsigned byte : bytes) {
    checksum ^= byte;
    for (int bit = 0; bit < 8; ++bit) checksum = checksum >> 1 ^ (checksum % 2) * 0xa001;
  }
  return static_cast<std::uint16_t>(checksum);
}

Bytes checked(std::span<const std::uint8_t> bytes) {
  Bytes frame(bytes.begin(), bytes.end());
  const std::uint16_t checksum = checksum_of(frame);
  frame.push_back(static_cast<std::uint8_t>(checksum));
  frame.push_back(static_cast<std::uint8_t>(checksum >> 8));
  return frame;
}

/// A line, and the bytes sent in which the next frame is still to be found.
class Line {
 public:
  void send(std::span<const std::uint8_t> bytes, milliseconds silence) {
    if (silence >= RtuFramer::kMaxGap && framer_.is_waiting()) {
      framer_.end();
      while (const auto frame = framer_.next()) check(*frame);
      require(!framer_.is_waiting(), "bytes that wait after the end");
    }
    sent_.insert(sent_.end(), bytes.begin(), bytes.end());
    // The silence precedes the first of several reads.
    while (!bytes.empty()) {
      const auto first = bytes.first(std::min(bytes.size(), RtuFramer::kLongestFrame));
      framer_.push(first, silence);
      silence = milliseconds(0);
      bytes = bytes.subspan(first.size());
      while (const auto frame = framer_.next()) check(*frame);
    }
  }

  const Bytes& last() const { return last_; }

 private:
  void check(std::span<const std::uint8_t> frame) {
    require(frame.size() >= 4 && frame.size() <= RtuFramer::kLongestFrame, "frame's size");
    require(frame[0] == kUnit || frame[0] == RtuFramer::kBroadcast, "a frame for another unit");
    require(checksum_of(frame) == 0, "frame's checksum");
    const auto rest = sent_.begin() + static_cast<std::ptrdiff_t>(cut_);
    const auto found = std::search(rest, sent_.end(), frame.begin(), frame.end());
    require(found != sent_.end(), "a frame that was not sent");
    cut_ = static_cast<std::size_t>(found - sent_.begin()) + frame.size();
    last_.assign(frame.begin(), frame.end());
  }

  RtuFramer framer_{kUnit, std::chrono::microseconds(1750)};
  Bytes sent_;
  std::size_t cut_ = 0;
  Bytes last_;
};

void run(ByteStream input) {
  Line line;
  while (!input.is_empty()) {
    const std::uint8_t piece = input.byte();
    const auto bytes = input.take(input.byte());
    const auto silence = kSilences[piece & kSilence];
    line.send(piece & kIsChecked ? checked(bytes) : Bytes(bytes.begin(), bytes.end()), silence);
  }
  constexpr std::array<std::uint8_t, 6> kRequest{kUnit, 3, 0x12, 0x34, 0, 1};
  const Bytes request = checked(kRequest);
  line.send(request, milliseconds(1000));
  require(line.last() == request, "a request after silence was not found");
}

}  // namespace
}  // namespace orbwatch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  orbwatch::fuzz::run(orbwatch::fuzz::ByteStream({data, size}));
  return 0;
}
