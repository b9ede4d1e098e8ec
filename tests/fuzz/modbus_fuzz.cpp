// SPDX-License-Identifier: Apache-2.0
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <vector>

#include "app/ports/modbus/machine_registers.h"
#include "app/ports/modbus/map/register_map.h"
#include "app/ports/modbus/plc_handshake.h"
#include "app/ports/modbus/server/mbap_framer.h"
#include "app/ports/modbus/server/responder.h"
#include "app/ports/modbus/server/transport.h"
#include "hal/thread/file_descriptor.h"
#include "tests/fuzz/byte_stream.h"
#include "tests/fuzz/stop.h"

/// A client that sends anything in any pieces: it receives complete answers to its requests, one
/// for each, and nothing is written without permission.
///
/// An input is one byte that determines whether the client may write, then pieces: a byte of bits
/// (see Piece), a length, and that number of bytes.
namespace orbwatch::fuzz {
namespace {

using app::modbus::MbapFramer;
using app::modbus::Outcome;
using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kHeader = 7;

/// A piece is sent unchanged, or as a frame with a right header, which chance would hardly find.
enum Piece : std::uint8_t { kIsProtocolDataUnit = 1, kForAnotherUnit = 2 };

Bytes frame(std::span<const std::uint8_t> pdu, std::uint8_t unit) {
  const std::size_t length = pdu.size() + 1;
  Bytes bytes(kHeader + pdu.size());
  bytes[0] = static_cast<std::uint8_t>(pdu.size());  // any transaction identifier
  bytes[4] = static_cast<std::uint8_t>(length >> 8);
  bytes[5] = static_cast<std::uint8_t>(length);
  bytes[6] = unit;
  std::ranges::copy(pdu, bytes.begin() + kHeader);
  return bytes;
}

std::size_t word(std::span<const std::uint8_t> bytes, std::size_t place) {
  return static_cast<std::size_t>(bytes[place] << 8 | bytes[place + 1]);
}

/// Required length of the protocol data unit that answers an executed request; 0: the answer states
/// it itself.
std::size_t answer_length(std::span<const std::uint8_t> request) {
  switch (request[0]) {
    case 1:
    case 2:
      return 2 + (word(request, 3) + 7) / 8;
    case 3:
    case 4:
    case 23:
      return 2 + 2 * word(request, 3);
    case 5:
    case 6:
    case 15:
    case 16:
      return 5;
    case 22:
      return 7;
    default:
      return 0;
  }
}

/// The map never changes, so that it is constructed once.
const app::modbus::RegisterMap& shared_map() {
  static const app::modbus::RegisterMap map;
  return map;
}

/// One connection.
class Connection {
 public:
  explicit Connection(bool may_write) : may_write_(may_write) {
    std::array<int, 2> ends{};
    require(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends.data()) == 0, "no sockets");
    server_ = hal::FileDescriptor(ends[0]);
    client_ = hal::FileDescriptor(ends[1]);
    auto responder = app::modbus::Responder::create(
        map_, [this](const app::modbus::Write& write) { return write_registers(write); },
        [this] {
          app::modbus::ProcessImage image;
          image.written = plc_.registers();
          image.plc = plc_.status({});
          return image;
        });
    auto transport = app::modbus::TcpTransport::create({0, 1, 255});
    require(responder && transport, "nothing to answer with");
    responder_ = std::move(*responder);
    transport_ = std::move(*transport);
    transport_->use(server_.get());
  }

  /// Sends bytes; false when the server ends the connection.
  bool send(std::span<const std::uint8_t> bytes) {
    sent_.insert(sent_.end(), bytes.begin(), bytes.end());
    while (!bytes.empty()) {
      const auto room = framer_.room();
      require(!room.empty(), "no room although no frame is whole");
      const std::size_t count = std::min(room.size(), bytes.size());
      std::ranges::copy(bytes.first(count), room.begin());
      framer_.commit(count);
      bytes = bytes.subspan(count);
      while (const auto next = framer_.next()) {
        check_frame(*next);
        if (!answer(*next)) return false;
      }
      if (framer_.is_broken()) return false;
    }
    return true;
  }

 private:
  std::optional<app::modbus::Exception> write_registers(const app::modbus::Write& write) {
    require(may_write_, "a write of a client that may only read");
    if (app::modbus::writes_machine_state(write.range)) {
      const auto refused = app::modbus::take_machine_state(write, map_, machine_);
      if (refused) return refused;
    }
    plc_.write(write, map_, {});
    const auto state = app::modbus::machine_state_in(plc_.registers().machine);
    require(state && app::check(*state), "a state that is refused is in the registers");
    return std::nullopt;
  }

  static Result<> take_state(const app::MachineState& state) { return app::check(state); }

  /// Frames are the bytes sent, without gaps.
  void check_frame(std::span<const std::uint8_t> frame) {
    require(frame.size() > kHeader && frame.size() <= MbapFramer::kLongestFrame, "frame's size");
    require(word(frame, 2) == 0 && word(frame, 4) == frame.size() - 6, "frame's header");
    require(std::ranges::equal(frame, std::span(sent_).subspan(cut_, frame.size())),
            "a frame that was not sent");
    cut_ += frame.size();
  }

  bool answer(std::span<const std::uint8_t> request) {
    const Bytes copy(request.begin(),
                     request.end());  // sized exactly, so that reads beyond it are detected
    const Outcome answered = responder_->answer(*transport_, copy, may_write_);
    require(answered != Outcome::NotSent, "an answer was not sent");
    std::array<std::uint8_t, 1024> buffer;
    const ssize_t count = ::recv(client_.get(), buffer.data(), buffer.size(), 0);
    const auto answer = std::span<const std::uint8_t>(buffer).first(
        static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (answered == Outcome::NotModbus) {
      require(answer.empty() && copy[kHeader] >= 0x80, "a request was taken for an answer");
      return false;
    }
    check_answer(copy, answer, answered);
    return true;
  }

  static void check_answer(std::span<const std::uint8_t> request,
                           std::span<const std::uint8_t> answer, Outcome answered) {
    require(answer.size() > kHeader && answer.size() <= MbapFramer::kLongestFrame, "answer's size");
    require(word(answer, 4) == answer.size() - 6, "answer's length, or more than one answer");
    require(std::ranges::equal(answer.first(4), request.first(4)) && answer[6] == request[6],
            "answer's transaction, protocol or unit");
    const auto pdu = answer.subspan(kHeader);
    const std::uint8_t function = request[kHeader];
    if (answered == Outcome::Refused || answered == Outcome::Forbidden) {
      require(pdu.size() == 2 && pdu[0] == (function | 0x80), "form of an exception");
      require((pdu[1] >= 1 && pdu[1] <= 3) || pdu[1] == 11, "number of an exception");
      return;
    }
    require(pdu[0] == function, "answer's function");
    const std::size_t length = answer_length(request.subspan(kHeader));
    require(length == 0 ? function == 43 : pdu.size() == length, "what is in the answer");
  }

  const bool may_write_;
  hal::FileDescriptor server_;
  hal::FileDescriptor client_;
  const app::modbus::RegisterMap& map_ = shared_map();
  const app::MachinePath machine_{app::MachineSource::Modbus, take_state};
  app::CommandRecord record_;
  app::modbus::PlcHandshake plc_{record_,
                                 [](const app::Command&) { return app::CommandResult::Done; },
                                 std::chrono::seconds(1),
                                 {}};
  std::unique_ptr<app::modbus::Responder> responder_;
  std::unique_ptr<app::modbus::TcpTransport> transport_;
  MbapFramer framer_;
  Bytes sent_;
  std::size_t cut_ = 0;  ///< number of bytes that were returned as frames
};

void run(ByteStream input) {
  Connection connection((input.byte() & 1) != 0);
  while (!input.is_empty()) {
    const std::uint8_t piece = input.byte();
    const auto bytes = input.take(input.byte());
    const std::uint8_t unit = piece & kForAnotherUnit ? 7 : 1;
    const bool is_open =
        piece & kIsProtocolDataUnit ? connection.send(frame(bytes, unit)) : connection.send(bytes);
    if (!is_open) return;
  }
}

}  // namespace
}  // namespace orbwatch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  orbwatch::fuzz::run(orbwatch::fuzz::ByteStream({data, size}));
  return 0;
}
