// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/server/rtu_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <random>
#include <thread>
#include <utility>

#include "hal/clock.h"
#include "tests/app/ports/modbus/clients.h"
#include "tests/app/ports/modbus/serial_cable.h"
#include "tests/support/reference_data.h"
#include "tests/support/subprocess.h"

namespace orbwatch::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using tests::address_of;
using tests::Bytes;
using tests::eventually;
using tests::kAcknowledged;
using tests::kSequence;
using tests::Plc;
using tests::RawMaster;
using tests::rtu_frame;

constexpr int kUnit = 17;
constexpr const char* kPython = "/usr/bin/python3";  // Debian's, for which its pymodbus is built
constexpr const char* kPymodbus = "/usr/lib/python3/dist-packages/pymodbus/client/serial.py";

/// The complete server, connected to the test by a cable.
class ModbusRtu : public testing::Test {
 protected:
  void start(bool may_write = true) {
    ModbusSettings settings = tests::loopback();
    settings.serial = {.device = cable_.device(),
                       .parity = Parity::None,
                       .unit_id = kUnit,
                       .may_write = may_write};
    sink_ = std::make_unique<ModbusSink>(settings, [this](const Command& command) {
      carried_out_.push_back(static_cast<int>(command.arguments[0]));
      return CommandResult::Done;
    });
    const auto started = sink_->start();
    ASSERT_TRUE(started) << started.error().message;
    sink_->accept(tests::example_status());
  }

  /// The output of pymodbus or mbpoll.
  std::string run(std::vector<std::string> arguments) {
    orbwatch::tests::Subprocess program(std::move(arguments), folder_ / "output");
    const int code = program.wait();
    EXPECT_EQ(code, 0) << program.output();
    return program.output();
  }

  modbus::ServerStatus statistics() const { return sink_->statistics(); }

  orbwatch::tests::TemporaryFolder folder_;
  tests::SerialCable cable_;
  std::vector<int> carried_out_;  ///< arguments of commands; read after stop()
  std::unique_ptr<ModbusSink> sink_;
};

/// Request of function 16 that selects view 2.
Bytes command(std::uint8_t sequence) {
  Bytes pdu{16, 0, 0, 0, 13, 26};
  for (const std::uint16_t word : tests::select_view(2, sequence)) {
    pdu.push_back(static_cast<std::uint8_t>(word >> 8));
    pdu.push_back(static_cast<std::uint8_t>(word));
  }
  return pdu;
}

const Bytes kReadVersion{4, 0, 0, 0, 1};
Bytes version() { return {4, 2, 0, modbus::kMapVersion}; }

TEST_F(ModbusRtu, ServesLibmodbusWithEveryFunction) {
  start();
  Plc plc(cable_.master(), kUnit);
  ASSERT_EQ(plc.read_input(0, 1), 0);
  EXPECT_EQ(plc.words, (tests::Words{modbus::kMapVersion}));
  ASSERT_EQ(plc.read_input(address_of("system_heartbeat"), 2), 0);
  EXPECT_EQ(plc.words, (tests::Words{1, 0x0102}));
  EXPECT_EQ(plc.read_discrete(0, 16), 0);
  EXPECT_EQ(plc.read_bits(modbus::kMirrorOffset, 16), 0);
  EXPECT_EQ(plc.command(0, tests::select_view(2, 41)), 0);
  ASSERT_EQ(plc.read_holding(kAcknowledged, 3), 0);
  EXPECT_EQ(plc.words, (tests::Words{41, 0, 1}));
  EXPECT_EQ(plc.command(kSequence, {42}), 0);
  EXPECT_EQ(plc.mask_write(kSequence, 0xfff0, 3), 0);
  EXPECT_TRUE(eventually([&] {
    EXPECT_EQ(plc.read_holding(kAcknowledged, 1), 0);
    return plc.words[0] == 0x23;
  }));
  ASSERT_EQ(plc.command(0, tests::select_view(2, 44)), 0);
  ASSERT_EQ(plc.write_and_read(0, tests::select_view(2, 44), kAcknowledged, 3), 0);
  EXPECT_EQ(plc.words, (tests::Words{44, 0, 1}));
  EXPECT_EQ(plc.write_coil(0), 2);
  EXPECT_EQ(plc.write_coils(0, 9), 2);
  EXPECT_EQ(plc.write(0, 1), 2) << "half of a double word";
  EXPECT_EQ(plc.read_input(65000, 1), 2);
  sink_->stop();
  EXPECT_THAT(carried_out_, ElementsAre(2, 2, 2, 2));
}

TEST_F(ModbusRtu, ServesMbpoll) {
  const std::string mbpoll = "/usr/bin/mbpoll";
  ORBWATCH_REQUIRE_FILE(mbpoll);
  start();
  const int heartbeat = address_of("system_heartbeat");
  const std::string unit = std::to_string(kUnit);
  EXPECT_THAT(run({mbpoll,
                   "-m",
                   "rtu",
                   "-b",
                   "19200",
                   "-P",
                   "none",
                   "-a",
                   unit,
                   "-0",
                   "-1",
                   "-o",
                   "10",
                   "-t",
                   "3",
                   "-r",
                   std::to_string(heartbeat),
                   "-c",
                   "2",
                   cable_.master()}),
              HasSubstr("[" + std::to_string(heartbeat + 1) + "]: \t258"));
}

TEST_F(ModbusRtu, ServesPymodbus) {
  ORBWATCH_REQUIRE_FILE(kPymodbus);
  start();
  EXPECT_EQ(
      run({kPython, std::string(ORBWATCH_SOURCE_DIR) + "/tests/app/ports/modbus/rtu_client.py",
           cable_.master(), std::to_string(kUnit)}),
      "read [" + std::to_string(modbus::kMapVersion) +
          "]\nheartbeat [1, 258]\nwrite written\nacknowledged [41, 0, 1]\nhalf exception 2\n"
          "nowhere exception 2\nidentity orbwatch\n");
}

TEST_F(ModbusRtu, RefusesEveryOtherFunction) {
  start();
  RawMaster master(cable_.master());
  const std::string served = "\1\2\3\4\5\6\17\20\26\27\53";
  for (int function = 0; function < 0x80; ++function) {
    if (served.find(static_cast<char>(function)) != served.npos) continue;
    const auto code = static_cast<std::uint8_t>(function);
    master.send(rtu_frame(kUnit, {code, 1, 2, 3}));
    EXPECT_EQ(master.receive(5), rtu_frame(kUnit, {static_cast<std::uint8_t>(code | 0x80), 1}));
  }
  EXPECT_TRUE(eventually([&] { return statistics().refused == 128U - served.size(); }));
}

TEST_F(ModbusRtu, IsSilentAboutWhatIsNotForIt) {
  start();
  RawMaster master(cable_.master());
  Bytes damaged = rtu_frame(kUnit, command(9));
  damaged.back() ^= 1;
  for (const Bytes& bytes : {rtu_frame(3, command(9)), rtu_frame(kUnit, {0x90, 2}), damaged}) {
    master.send(bytes);
  }
  EXPECT_TRUE(eventually(
      [&] { return statistics().serial_errors == 1 && statistics().serial_other_units == 1; }));
  // An answer to them would have arrived first.
  const Bytes request = rtu_frame(kUnit, kReadVersion);
  EXPECT_TRUE(eventually([&] {
    master.send(request);
    const Bytes answer = master.receive(7, std::chrono::milliseconds(100));
    return answer == rtu_frame(kUnit, version());
  }));
  sink_->stop();
  EXPECT_THAT(carried_out_, ElementsAre());
}

TEST_F(ModbusRtu, CarriesOutWhatIsForAllWithoutAnAnswer) {
  start();
  RawMaster master(cable_.master());
  master.send(rtu_frame(0, command(7)));
  master.send(rtu_frame(0, {4, 0, 0, 0, 1}));
  master.send(rtu_frame(0, {16, 0, 0, 0, 1, 2, 0, 1}));  // half a double word
  master.send(rtu_frame(0, {43, 14, 1, 0}));
  master.send(rtu_frame(0, {99}));
  EXPECT_TRUE(eventually([&] {
    master.send(rtu_frame(kUnit, {3, 0, static_cast<std::uint8_t>(kAcknowledged), 0, 3}));
    return master.receive(11) == rtu_frame(kUnit, {3, 6, 0, 7, 0, 0, 0, 1});
  }));
  sink_->stop();
  EXPECT_THAT(carried_out_, ElementsAre(2));
}

TEST_F(ModbusRtu, MayBeForReadingOnly) {
  start(false);
  RawMaster master(cable_.master());
  master.send(rtu_frame(kUnit, command(7)));
  EXPECT_EQ(master.receive(5), rtu_frame(kUnit, {0x90, 1}));
  master.send(rtu_frame(kUnit, kReadVersion));
  EXPECT_EQ(master.receive(7), rtu_frame(kUnit, version()));
  sink_->stop();
  EXPECT_THAT(carried_out_, ElementsAre());
}

TEST_F(ModbusRtu, SharesItsRegistersWithTcp) {
  start();
  Plc serial(cable_.master(), kUnit);
  Plc tcp(sink_->port());
  ASSERT_EQ(serial.command(0, tests::select_view(2, 41)), 0);
  ASSERT_EQ(tcp.read_holding(kAcknowledged, 1), 0);
  EXPECT_EQ(tcp.words[0], 41);
  ASSERT_EQ(tcp.command(kSequence, {42}), 0);
  ASSERT_EQ(serial.read_holding(kAcknowledged, 1), 0);
  EXPECT_EQ(serial.words[0], 42);
}

TEST_F(ModbusRtu, AFloodOfNoiseStopsNobody) {
  start();
  RawMaster master(cable_.master());
  Plc tcp(sink_->port());
  std::mt19937 random(20240603);
  for (int i = 0; i < 500; ++i) {
    Bytes noise(512);
    for (auto& byte : noise) byte = static_cast<std::uint8_t>(random());
    master.send(noise);
    ASSERT_EQ(tcp.read_input(0, 1), 0);
  }
  EXPECT_TRUE(eventually([&] {
    master.send(rtu_frame(kUnit, kReadVersion));
    return master.receive(7, std::chrono::milliseconds(100)) == rtu_frame(kUnit, version());
  }));
  EXPECT_GT(statistics().serial_errors, 0U);
}

TEST_F(ModbusRtu, AMasterThatNeverReadsStopsNobody) {
  start();
  RawMaster deaf(cable_.master());
  Plc tcp(sink_->port());
  for (int i = 0; i < 2000; ++i) {
    deaf.send(rtu_frame(kUnit, {4, 0, 0, 0, 96}));
    ASSERT_EQ(tcp.read_input(0, 1), 0);
  }
}

/// Master on a line whose adapter echoes the appliance's answers, in pieces of `piece` bytes,
/// before the next request.
class EchoingMaster {
 public:
  explicit EchoingMaster(const std::string& path) : master_(path) {}

  /// The answer, which is not echoed; empty: none within a second.
  Bytes ask(const Bytes& request, std::size_t size) {
    const auto before = std::exchange(asked_, hal::Clock::now());
    master_.send(request);
    Bytes answer = master_.receive(size, std::chrono::seconds(1));
    is_late_ = is_late_ || hal::Clock::now() - before > kLatest;
    return answer;
  }
  /// The answer, which is echoed to its sender.
  Bytes ask(const Bytes& request, std::size_t size, std::size_t piece) {
    const Bytes answer = ask(request, size);
    for (std::size_t at = 0; at < answer.size(); at += piece) {
      const auto begin = answer.begin() + static_cast<std::ptrdiff_t>(at);
      master_.send(Bytes(begin, begin + std::ptrdiff_t(std::min(piece, answer.size() - at))));
    }
    return answer;
  }

  /// True: an echo may have been so late that it was not expected any more. The answer to the next
  /// request shows that it has been read.
  bool is_late() const { return is_late_; }

 private:
  /// Limit from a request to the answer to the next one. The appliance expects an echo for 150 ms.
  static constexpr std::chrono::milliseconds kLatest{100};

  RawMaster master_;
  hal::TimePoint asked_ = hal::TimePoint::max();  ///< time of the last request; max(): none
  bool is_late_ = false;
};

const auto kHeartbeatRegister = static_cast<std::uint8_t>(address_of("plc_heartbeat"));
constexpr std::uint64_t kEchoed = 30;  ///< answers that are echoed

/// Returns whether the appliance answers kEchoed requests and one more, each of them once.
bool echoes_are_removed(EchoingMaster& master) {
  const Bytes read = rtu_frame(kUnit, kReadVersion), said = rtu_frame(kUnit, version());
  for (const std::size_t piece : {100U, 3U, 1U}) {
    for (std::uint8_t value = 1; value <= 5; ++value) {
      const Bytes write = rtu_frame(kUnit, {6, 0, kHeartbeatRegister, 0, value});
      if (master.ask(write, 8, piece) != write || master.ask(read, 7, piece) != said) return false;
    }
  }
  return master.ask(read, 7) == said;
}

/// Outcome of requests to a new appliance on a line that echoes.
class EchoedAnswers : public ModbusRtu {
 protected:
  void ask() {
    start();
    EchoingMaster master(cable_.master());
    testing::internal::CaptureStderr();
    are_removed_ = echoes_are_removed(master);
    is_late_ = master.is_late();
    sink_->stop();
    log_ = testing::internal::GetCapturedStderr();
  }
  /// Removes the bytes that are on their way.
  void change_cable() {
    cable_.unplug();
    cable_.plug_in();
  }

  bool are_removed_ = false;
  bool is_late_ = false;
  std::string log_;
};

TEST_F(EchoedAnswers, AreNotAnswered) {
  ask();
  // On a busy machine an echo may be later than the appliance expects it.
  for (int again = 0; is_late_ && again < 20; ++again) {
    change_cable();
    ask();
  }
  ASSERT_FALSE(is_late_);
  EXPECT_TRUE(are_removed_);
  EXPECT_EQ(statistics().serial_echoes, kEchoed);
  EXPECT_EQ(statistics().answered, kEchoed + 1);
  EXPECT_EQ(statistics().serial_errors, 0U);
  const std::size_t said = log_.find("echoes sent answers");
  ASSERT_NE(said, log_.npos) << log_;
  EXPECT_EQ(log_.find("echoes sent answers", said + 1), log_.npos) << log_;
}

TEST_F(ModbusRtu, AMasterThatRepeatsItsWriteIsAnswered) {
  start();
  RawMaster master(cable_.master());
  const Bytes write = rtu_frame(kUnit, {6, 0, kHeartbeatRegister, 0, 5});
  for (int i = 0; i < 3; ++i) {
    master.send(rtu_frame(kUnit, kReadVersion));
    ASSERT_EQ(master.receive(7), rtu_frame(kUnit, version()));
    for (int repetition = 0; repetition < 3; ++repetition) {
      master.send(write);
      ASSERT_EQ(master.receive(8), write) << repetition;
    }
  }
  EXPECT_EQ(statistics().serial_echoes, 0U);
}

TEST_F(ModbusRtu, ARequestBehindStrayBytesIsAnswered) {
  start();
  RawMaster master(cable_.master());
  const Bytes request = rtu_frame(kUnit, kReadVersion);
  const Bytes half(request.begin(), request.begin() + 5);
  std::uint64_t errors = 0;
  for (const Bytes& front : {Bytes{0}, Bytes{0xff}, Bytes{kUnit}, Bytes{3, 0, 0xff}, half}) {
    Bytes line = front;
    line.insert(line.end(), request.begin(), request.end());
    master.send(line);
    ASSERT_EQ(master.receive(7), rtu_frame(kUnit, version())) << int{front[0]};
    EXPECT_TRUE(eventually([&] { return statistics().serial_errors > errors; }));
    errors = statistics().serial_errors;
  }
}

/// A PLC commands over the serial line while another program uses the port of Modbus TCP.
TEST_F(ModbusRtu, ASilentPlcIsSupervisedWithoutTcp) {
  ModbusSink other(tests::loopback(), tests::accept_all);
  ASSERT_TRUE(other.start());
  ModbusSettings settings = tests::loopback();
  settings.port = other.port();
  settings.plc_timeout_ms = 200;
  settings.serial = {.device = cable_.device(), .parity = Parity::None, .unit_id = kUnit};
  std::atomic<int> active{-1};
  ModbusSink sink(settings, [&](const Command& command) {
    if (command.code == CommandCode::SetProcessActive) {
      active = static_cast<int>(command.arguments[0]);
    }
    return CommandResult::Done;
  });
  ASSERT_FALSE(sink.start()) << "the port is in use";
  Plc plc(cable_.master(), kUnit);
  constexpr auto kCode = static_cast<std::uint16_t>(CommandCode::SetProcessActive);
  ASSERT_EQ(plc.command(0, {0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, kCode, 1}), 0);
  EXPECT_TRUE(eventually([&] { return active == 0; })) << "its heartbeat does not change";
  sink.stop();
}

/// The reports of the server about its line.
class LineStates {
 public:
  void add(const Result<>& line) {
    const std::lock_guard lock(mutex_);
    states_.push_back(line ? "back" : line.error().message);
  }
  std::vector<std::string> all() {
    const std::lock_guard lock(mutex_);
    return states_;
  }

 private:
  std::mutex mutex_;
  std::vector<std::string> states_;
};

/// A server that refuses every request, to test its line alone.
class RtuLine : public testing::Test {
 protected:
  void start() {
    auto server = modbus::RtuServer::open(
        {.device = cable_.device(), .parity = Parity::None, .unit_id = kUnit},
        [](modbus::Transport& transport, std::span<const std::uint8_t> frame) {
          transport.refuse(frame, modbus::Exception::IllegalFunction);
          return modbus::Outcome::Refused;
        },
        [this](const Result<>& line) { states_.add(line); }, counters_);
    ASSERT_TRUE(server) << server.error().message;
    server_ = std::move(*server);
    thread_ = std::thread([this] { server_->run(); });
  }
  void TearDown() override {
    server_->stop();
    thread_.join();
  }
  void expect_answer() {
    RawMaster master(cable_.master());
    master.send(rtu_frame(kUnit, {4, 0, 0, 0, 1}));
    EXPECT_EQ(master.receive(5), rtu_frame(kUnit, {0x84, 1}));
  }
  bool has_said(std::size_t count) {
    return eventually([&] { return states_.all().size() >= count; });
  }

  tests::SerialCable cable_;
  LineStates states_;
  modbus::ServerCounters counters_;
  std::unique_ptr<modbus::RtuServer> server_;
  std::thread thread_;
};

TEST_F(RtuLine, ThatGoesAwayIsReportedOnceAndServedAgain) {
  start();
  expect_answer();
  for (std::size_t round = 1; round <= 2; ++round) {
    cable_.unplug();
    ASSERT_TRUE(has_said(2 * round - 1));
    cable_.plug_in();
    ASSERT_TRUE(has_said(2 * round));
    expect_answer();
  }
  const auto is_lost = HasSubstr("serial line " + cable_.device() + " is lost");
  EXPECT_THAT(states_.all(), ElementsAre(is_lost, "back", is_lost, "back"));
}

TEST_F(RtuLine, ThatIsNotThereIsWaitedFor) {
  cable_.unplug();
  start();
  ASSERT_TRUE(has_said(1));
  cable_.plug_in();
  ASSERT_TRUE(has_said(2));
  expect_answer();
  EXPECT_THAT(states_.all(), ElementsAre(HasSubstr("cannot open the serial line"), "back"));
}

TEST(RtuServer, SaysWhichSettingIsWrong) {
  modbus::ServerCounters counters;
  const auto error = [&](const ModbusSerialSettings& settings) {
    const auto server = modbus::RtuServer::open(settings, {}, {}, counters);
    return server ? "" : server.error().message;
  };
  EXPECT_THAT(error({}), HasSubstr("device is not set"));
  EXPECT_THAT(error({.device = "/dev/ttyS0", .baud_rate = 19201}), HasSubstr("baud_rate 19201"));
  EXPECT_THAT(error({.device = "/dev/ttyS0", .stop_bits = 3}), HasSubstr("stop_bits"));
  EXPECT_THAT(error({.device = "/dev/ttyS0", .unit_id = 0}), HasSubstr("unit_id"));
  EXPECT_THAT(error({.device = "/dev/ttyS0", .unit_id = 248}), HasSubstr("unit_id"));
}

}  // namespace
}  // namespace orbwatch::app
