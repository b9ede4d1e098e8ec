// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include <fstream>
#include <iomanip>
#include <memory>
#include <sstream>

#include "tests/app/ports/modbus/clients.h"

namespace orbwatch::app {
namespace {

using tests::accept_all;
using tests::Bytes;
using tests::eventually;
using tests::frame;
using tests::loopback;
using tests::Plc;
using tests::RawClient;

const Bytes kRead = frame({4, 0, 0, 0, 1});
const Bytes kAnswer{4, 2, 0, modbus::kMapVersion};

/// A server with one well-behaved client, which the others must not affect.
class ModbusAbuse : public testing::Test {
 protected:
  void start(const ModbusSettings& settings) {
    sink_ = std::make_unique<ModbusSink>(settings, accept_all);
    const auto started = sink_->start();
    ASSERT_TRUE(started) << started.error().message;
    plc_ = std::make_unique<Plc>(sink_->port());
    ASSERT_TRUE(plc_is_served());
  }
  bool plc_is_served() {
    return plc_->read_input(0, 96) == 0 && plc_->words[0] == modbus::kMapVersion;
  }
  int port() const { return sink_->port(); }
  modbus::ServerStatus statistics() const { return sink_->statistics(); }

  std::unique_ptr<ModbusSink> sink_;
  std::unique_ptr<Plc> plc_;
};

TEST_F(ModbusAbuse, FramesThatAreNotModbusEndTheConnection) {
  start(loopback());
  const Bytes not_modbus[] = {
      {0, 1, 0, 1, 0, 6, 1, 4, 0, 0, 0, 1},      // protocol 1
      {0, 1, 1, 0, 0, 6, 1, 4, 0, 0, 0, 1},      // protocol 256
      {0, 1, 0, 0, 0, 1, 1},                     // no room for a function code
      {0, 1, 0, 0, 0, 0},                        // no room for anything
      {0, 1, 0, 0, 0, 255, 1, 4, 0, 0, 0, 1},    // longer than Modbus allows
      {0, 1, 0, 0, 255, 255, 1, 4, 0, 0, 0, 1},  //
      {'G', 'E', 'T', ' ', '/', ' ', 'H', 'T'},  // HTTP
      {0, 1, 0, 0, 0, 3, 1, 0x84, 2},            // an answer
  };
  std::uint64_t count = 0;
  for (const Bytes& bytes : not_modbus) {
    RawClient client(port());
    ASSERT_TRUE(client.send(bytes));
    EXPECT_TRUE(client.is_closed_by_server());
    EXPECT_TRUE(plc_is_served());
    ++count;
    EXPECT_EQ(statistics().refused, count);
    EXPECT_TRUE(eventually([&] { return statistics().dropped == count; }));
  }
}

TEST_F(ModbusAbuse, FramesCutAnywhereAreAnswered) {
  start(loopback());
  RawClient client(port());
  for (std::size_t cut = 1; cut < kRead.size(); ++cut) {
    ASSERT_TRUE(client.send(Bytes(kRead.begin(), kRead.begin() + static_cast<long>(cut))));
    ASSERT_TRUE(plc_is_served());  // the server received the first part only
    ASSERT_TRUE(client.send(Bytes(kRead.begin() + static_cast<long>(cut), kRead.end())));
    EXPECT_EQ(tests::receive_pdu(client), kAnswer) << cut;
  }
}

TEST_F(ModbusAbuse, FramesInOnePieceAreAnsweredInOrder) {
  start(loopback());
  RawClient client(port());
  Bytes burst;
  for (std::uint16_t transaction = 0; transaction < 200; ++transaction) {
    const Bytes request = frame({4, 0, 0, 0, 1}, 255, transaction);
    burst.insert(burst.end(), request.begin(), request.end());
  }
  ASSERT_TRUE(client.send(burst));
  client.finish_sending();
  for (int transaction = 0; transaction < 200; ++transaction) {
    const Bytes answer = client.receive(11);
    ASSERT_EQ(answer.size(), 11U);
    EXPECT_EQ(answer[0] << 8 | answer[1], transaction);
  }
  EXPECT_TRUE(client.is_closed_by_server());
  EXPECT_EQ(statistics().dropped, 0U);
}

TEST_F(ModbusAbuse, ADripFeedingClientDelaysNobodyAndIsDropped) {
  using std::chrono::milliseconds;
  ModbusSettings settings = loopback();
  settings.frame_timeout = milliseconds(100);
  start(settings);
  RawClient dripping(port());
  const Bytes longest = frame(Bytes(253, 16));
  bool is_open = true;
  for (std::size_t i = 0; is_open && i + 1 < longest.size(); ++i) {
    is_open = dripping.send({longest[i]});
    // Slow enough that the complete frame would take several times the timeout.
    const auto next = hal::Clock::now() + milliseconds(2);
    do {
      ASSERT_TRUE(plc_is_served());
    } while (hal::Clock::now() < next);
  }
  EXPECT_FALSE(is_open) << "every byte gave it more time";
  EXPECT_EQ(statistics().dropped, 1U);
  EXPECT_EQ(statistics().connections, 1U);
}

TEST_F(ModbusAbuse, HalfAFrameIsDroppedInTime) {
  ModbusSettings settings = loopback();
  settings.frame_timeout = std::chrono::milliseconds(20);
  start(settings);
  RawClient half(port());
  // A complete request comes first, because the time counts from the first byte of each request.
  Bytes bytes = kRead;
  bytes.insert(bytes.end(), kRead.begin(), kRead.begin() + 9);
  ASSERT_TRUE(half.send(bytes));
  EXPECT_EQ(tests::receive_pdu(half), kAnswer);
  EXPECT_TRUE(half.is_closed_by_server());
  EXPECT_TRUE(plc_is_served());
}

TEST_F(ModbusAbuse, AStreamOfRequestsThatIsNeverAtRestIsNoPartialFrame) {
  ModbusSettings settings = loopback();
  settings.frame_timeout = std::chrono::seconds(2);
  start(settings);
  RawClient streaming(port());
  const Bytes first_half(kRead.begin(), kRead.begin() + 5);
  Bytes next(kRead.begin() + 5, kRead.end());
  next.insert(next.end(), first_half.begin(), first_half.end());
  ASSERT_TRUE(streaming.send(first_half));
  // The server always has a partial request, but never an old one.
  const auto end = hal::Clock::now() + std::chrono::milliseconds(2500);
  while (hal::Clock::now() < end) {
    ASSERT_TRUE(streaming.send(next));
    ASSERT_EQ(tests::receive_pdu(streaming), kAnswer);
  }
}

/// The kernel's timer for the server's end of its only connection, from /proc/net/tcp; 2:
/// keep-alive.
std::string timer_of_connection(int port) {
  std::ifstream sockets("/proc/self/net/tcp");
  std::ostringstream local;
  local << ':' << std::uppercase << std::hex << std::setw(4) << std::setfill('0') << port;
  std::string line;
  while (std::getline(sockets, line)) {
    std::istringstream fields(line);
    std::string number, address, peer, state, queues, timer;
    fields >> number >> address >> peer >> state >> queues >> timer;
    if (address.ends_with(local.str()) && state == "01") return timer.substr(0, 2);
  }
  return "none";
}

TEST_F(ModbusAbuse, AnIdleConnectionStaysAndIsProbed) {
  ModbusSettings settings = loopback();
  settings.idle_time = std::chrono::milliseconds(1);
  start(settings);
  const auto connected = statistics().answered;
  // Makes the server's loop run after the time has expired.
  RawClient other(port());
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(other.send(kRead));
    ASSERT_EQ(tests::receive_pdu(other), kAnswer);
  }
  EXPECT_EQ(statistics().connections, 2U);
  EXPECT_EQ(statistics().dropped, 0U);
  EXPECT_TRUE(plc_is_served());
  EXPECT_GT(statistics().answered, connected);
  EXPECT_TRUE(eventually([&] { return timer_of_connection(port()) == "02"; }));
}

TEST_F(ModbusAbuse, AReaderTakesThePlaceOfAnIdleWriterOnly) {
  ModbusSettings settings = loopback();
  settings.max_connections = 2;
  settings.writers = {"127.0.0.1"};
  settings.idle_time = std::chrono::milliseconds(200);
  start(settings);
  RawClient idle(port());
  ASSERT_TRUE(idle.send(kRead));
  ASSERT_EQ(tests::receive_pdu(idle), kAnswer);
  const auto end = hal::Clock::now() + 2 * settings.idle_time;
  while (hal::Clock::now() < end) ASSERT_TRUE(plc_is_served());
  RawClient reader(port(), "127.0.0.2");
  ASSERT_TRUE(reader.send(kRead));
  EXPECT_EQ(tests::receive_pdu(reader), kAnswer);
  EXPECT_TRUE(idle.is_closed_by_server());
  EXPECT_TRUE(plc_is_served());
}

TEST_F(ModbusAbuse, AClientThatTakesNoAnswersIsDropped) {
  start(loopback());
  RawClient deaf(port(), "127.0.0.1", 2048);
  const Bytes request = frame({4, 0, 0, 0, 96});
  std::size_t at = 0;
  for (;;) {
    const long sent = deaf.send_some(Bytes(request.begin() + static_cast<long>(at), request.end()));
    if (sent < 0) break;
    at = (at + static_cast<std::size_t>(sent)) % request.size();
    if (sent == 0) deaf.wait_writable();
    ASSERT_LT(statistics().answered, 1000000U) << "answers pile up somewhere";
  }
  EXPECT_TRUE(plc_is_served());
  EXPECT_TRUE(eventually([&] { return statistics().dropped == 1; }));
}

TEST_F(ModbusAbuse, WhenThereAreTooManyTheOneThatWasQuietLongestGoes) {
  ModbusSettings settings = loopback();
  settings.max_connections = 3;
  start(settings);
  RawClient second(port());
  RawClient third(port());
  for (RawClient* client : {&second, &third}) {
    ASSERT_TRUE(client->send(kRead));
    ASSERT_EQ(tests::receive_pdu(*client), kAnswer);
  }
  ASSERT_TRUE(plc_is_served());  // so that the first is no longer idle longest
  RawClient fourth(port());
  ASSERT_TRUE(fourth.send(kRead));
  EXPECT_EQ(tests::receive_pdu(fourth), kAnswer);
  EXPECT_TRUE(second.is_closed_by_server());
  ASSERT_TRUE(third.send(kRead));
  EXPECT_EQ(tests::receive_pdu(third), kAnswer);
  EXPECT_TRUE(plc_is_served());
  EXPECT_EQ(statistics().dropped, 1U);
  EXPECT_EQ(statistics().connections, 3U);
}

TEST_F(ModbusAbuse, ReadersDoNotPushWritersOut) {
  ModbusSettings settings = loopback();
  settings.max_connections = 3;
  settings.writers = {"127.0.0.1"};
  start(settings);
  RawClient silent_writer(port());
  std::vector<std::unique_ptr<RawClient>> readers;
  for (int i = 0; i < 20; ++i) {
    readers.push_back(std::make_unique<RawClient>(port(), "127.0.0.2"));
    ASSERT_TRUE(readers.back()->send(kRead));
    EXPECT_EQ(tests::receive_pdu(*readers.back()), kAnswer);
  }
  EXPECT_TRUE(plc_is_served());
  ASSERT_TRUE(silent_writer.send(kRead));
  EXPECT_EQ(tests::receive_pdu(silent_writer), kAnswer);
  EXPECT_EQ(statistics().dropped, 19U);
}

TEST_F(ModbusAbuse, AServerFullOfWritersTakesNoReader) {
  ModbusSettings settings = loopback();
  settings.max_connections = 2;
  settings.writers = {"127.0.0.1"};
  start(settings);
  ASSERT_TRUE(plc_is_served());
  RawClient silent_writer(port());
  ASSERT_TRUE(silent_writer.send(kRead));
  ASSERT_EQ(tests::receive_pdu(silent_writer), kAnswer);
  RawClient reader(port(), "127.0.0.2");
  EXPECT_TRUE(reader.is_closed_by_server());
  ASSERT_TRUE(silent_writer.send(kRead));
  EXPECT_EQ(tests::receive_pdu(silent_writer), kAnswer);
  EXPECT_TRUE(plc_is_served());
}

TEST_F(ModbusAbuse, AMachineWithManyConnectionsPushesNobodyElseOut) {
  ModbusSettings settings = loopback();
  settings.max_connections = 4;
  start(settings);
  ASSERT_TRUE(plc_is_served());
  std::vector<std::unique_ptr<RawClient>> many;
  for (int i = 0; i < 20; ++i) {
    many.push_back(std::make_unique<RawClient>(port(), "127.0.0.2"));
    ASSERT_TRUE(many.back()->send(kRead));
    EXPECT_EQ(tests::receive_pdu(*many.back()), kAnswer);
  }
  EXPECT_TRUE(plc_is_served()) << "the quietest of all";
  EXPECT_EQ(statistics().dropped, 17U);
}

TEST_F(ModbusAbuse, StrangersAreNotLetIn) {
  ModbusSettings settings = loopback();
  settings.max_connections = 2;
  settings.readers = {"127.0.0.0/31"};
  settings.writers = {"127.0.0.4"};
  start(settings);
  RawClient writer(port(), "127.0.0.4");
  ASSERT_TRUE(writer.send(kRead));
  EXPECT_EQ(tests::receive_pdu(writer), kAnswer);
  for (int i = 0; i < 20; ++i) {
    RawClient stranger(port(), "127.0.0.2");
    EXPECT_TRUE(stranger.is_closed_by_server());
  }
  EXPECT_TRUE(eventually([&] { return statistics().dropped == 20; }));
  EXPECT_TRUE(plc_is_served());
  ASSERT_TRUE(writer.send(kRead)) << "strangers take nobody's place";
  EXPECT_EQ(tests::receive_pdu(writer), kAnswer);
  EXPECT_EQ(plc_->write(3, 1), 1);
}

TEST_F(ModbusAbuse, ConnectionsThatAskNothingDoNotPushThePlcOut) {
  ModbusSettings settings = loopback();
  settings.max_connections = 4;
  start(settings);
  std::vector<std::unique_ptr<RawClient>> silent;
  for (int i = 0; i < 50; ++i) silent.push_back(std::make_unique<RawClient>(port()));
  EXPECT_TRUE(eventually([&] { return statistics().dropped == 47; }));
  EXPECT_TRUE(plc_is_served());
  EXPECT_EQ(statistics().connections, 4U);
}

/// Prevents the process from opening file descriptors during its lifetime.
class NoMoreFiles {
 public:
  NoMoreFiles() {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const hal::FileDescriptor next(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    rlimit limit = before_;
    limit.rlim_cur = static_cast<rlim_t>(next.get());
    ::setrlimit(RLIMIT_NOFILE, &limit);
  }
  ~NoMoreFiles() { ::setrlimit(RLIMIT_NOFILE, &before_); }

 private:
  rlimit before_{};
};

TEST_F(ModbusAbuse, RunningOutOfFilesDelaysOnlyTheNewcomer) {
  start(loopback());
  RawClient newcomer(tests::Unconnected{});
  {
    const NoMoreFiles no_more_files;
    newcomer.connect(port());  // the kernel accepts it, the server cannot
    ASSERT_TRUE(newcomer.send(kRead));
    for (int i = 0; i < 100; ++i) ASSERT_TRUE(plc_is_served());
    EXPECT_EQ(statistics().connections, 1U);
  }
  EXPECT_EQ(tests::receive_pdu(newcomer), kAnswer);
}

}  // namespace
}  // namespace orbwatch::app
