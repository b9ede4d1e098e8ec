// SPDX-License-Identifier: Apache-2.0
#include "tests/app/ports/modbus/abuses.h"

#include <array>
#include <map>
#include <random>

#include "tests/app/ports/modbus/clients.h"

namespace orbwatch::app::tests {
namespace {

using orbwatch::tests::Abuse;
using orbwatch::tests::begin_crowd;
using orbwatch::tests::Returning;

const Bytes kRequest = frame({4, 0, 0, 0, 96});
/// A refused write of the largest length.
const Bytes kLongest = frame(Bytes(253, 16));

struct Drip {
  std::size_t place = 0;
  void operator()(Returning& client) {
    client.listen();
    client.send(Bytes{kLongest[place++ % kLongest.size()]});
  }
};

struct SendHalf {
  void operator()(Returning& client) {
    if (client.is_open()) return client.listen();
    if (client.client().send_some(Bytes(kRequest.begin(), kRequest.begin() + 7)) < 0) {
      client.leave();
    }
  }
};

struct Ask {
  void operator()(Returning& client) {
    client.listen();
    client.send(kRequest);
  }
};

struct NeverRead {
  void operator()(Returning& client) {
    for (int i = 0; i < 100; ++i) client.send(kRequest);
  }
};

struct AskEveryFunction {
  std::uint8_t function = 0;
  void operator()(Returning& client) {
    client.listen();
    client.send(frame({function++, 0, 0, 0, 1, 2, 3, 4}));
  }
};

struct SendNoise {
  std::mt19937 random{20240604};
  void operator()(Returning& client) {
    Bytes noise(1 + random() % 253);
    for (auto& byte : noise) byte = static_cast<std::uint8_t>(random());
    // Every second frame has a valid header, so that its content is parsed.
    const bool is_framed = random() % 2 == 0;
    if (is_framed) noise[0] &= 0x1f;
    client.listen();
    if (client.client().send_some(is_framed ? frame(noise) : noise) < 0) client.leave();
  }
};

/// Sends a burst whenever all earlier requests were answered.
struct AskWithoutPause {
  static constexpr long kRequests = 20;
  static constexpr long kAnswers = kRequests * (9 + 2 * 96);
  Bytes burst = [] {
    Bytes bytes;
    for (long i = 0; i < kRequests; ++i) {
      bytes.insert(bytes.end(), kRequest.begin(), kRequest.end());
    }
    return bytes;
  }();
  std::map<Returning*, long> expected;

  void operator()(Returning& client) {
    client.listen();
    if (client.received() != expected[&client]) return;
    client.send(burst);
    expected[&client] += kAnswers;
  }
};

using std::chrono::microseconds;
constexpr std::array kAbuses{
    Abuse{"slow drip from 20 clients", microseconds(5000), false, begin_crowd<Drip, 20>},
    Abuse{"half frames from 20 clients", microseconds(1000), false, begin_crowd<SendHalf, 20>},
    Abuse{"200 connections", microseconds(10000), false, begin_crowd<Ask, 200>},
    Abuse{"10 clients that never read", microseconds(1000), false,
          begin_crowd<NeverRead, 10, 2048>},
    Abuse{"all 256 function codes", microseconds(100), false, begin_crowd<AskEveryFunction, 4>},
    Abuse{"random frames", microseconds(500), false, begin_crowd<SendNoise, 4>},
    Abuse{"10 clients that ask without pause", microseconds(0), true,
          begin_crowd<AskWithoutPause, 10>},
};

}  // namespace

std::span<const orbwatch::tests::Abuse> abuses() { return kAbuses; }

}  // namespace orbwatch::app::tests
