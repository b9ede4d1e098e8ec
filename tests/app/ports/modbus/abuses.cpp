#include "tests/app/ports/modbus/abuses.h"

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <vector>

#include "tests/app/ports/modbus/clients.h"

namespace orbwatch::app::tests {
namespace {

const Bytes kRequest = frame({4, 0, 0, 0, 96});
/// A write that is refused, but as long as one may be.
const Bytes kLongest = frame(Bytes(253, 16));

/// A client that connects again when the server closed its connection.
class Returning {
 public:
  explicit Returning(int port, int receive_buffer = 0)
      : port_(port), receive_buffer_(receive_buffer) {}

  bool is_open() const { return client_ != nullptr; }
  RawClient& client() {
    if (!client_) client_ = std::make_unique<RawClient>(port_, "127.0.0.2", receive_buffer_);
    return *client_;
  }

  /// Sends as much as possible; the rest with the next call.
  void send(const Bytes& bytes) {
    const Bytes rest(bytes.begin() + static_cast<long>(sent_), bytes.end());
    const long count = client().send_some(rest);
    if (count < 0) return leave();
    sent_ = (sent_ + static_cast<std::size_t>(count)) % bytes.size();
  }
  void listen() {
    const long count = client_ ? client_->discard() : 0;
    if (count < 0) return leave();
    received_ += count;
  }
  /// Bytes since it connected.
  long received() const { return received_; }
  void leave() { *this = Returning(port_, receive_buffer_); }

 private:
  int port_;
  int receive_buffer_;
  std::size_t sent_ = 0;  ///< of a message that did not go whole
  long received_ = 0;
  std::unique_ptr<RawClient> client_;
};

/// So many of them that do the same.
template <class Behaviour>
class Crowd final : public Abusers {
 public:
  Crowd(int port, std::size_t count, int receive_buffer = 0)
      : clients_(make(port, count, receive_buffer)) {}

  void act() override {
    for (Returning& client : clients_) behaviour_(client);
  }

 private:
  static std::vector<Returning> make(int port, std::size_t count, int receive_buffer) {
    std::vector<Returning> clients;
    for (std::size_t i = 0; i < count; ++i) clients.emplace_back(port, receive_buffer);
    return clients;
  }

  std::vector<Returning> clients_;
  Behaviour behaviour_;
};

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
    // Every other one has a right header, so that its content gets further.
    const bool is_framed = random() % 2 == 0;
    if (is_framed) noise[0] &= 0x1f;
    client.listen();
    if (client.client().send_some(is_framed ? frame(noise) : noise) < 0) client.leave();
  }
};

/// A burst whenever all earlier requests were answered.
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

template <class Behaviour, std::size_t kCount, int kReceiveBuffer = 0>
std::unique_ptr<Abusers> begin(int port) {
  return std::make_unique<Crowd<Behaviour>>(port, kCount, kReceiveBuffer);
}

using std::chrono::microseconds;
constexpr std::array kAbuses{
    Abuse{"slow drip from 20 clients", microseconds(5000), false, begin<Drip, 20>},
    Abuse{"half frames from 20 clients", microseconds(1000), false, begin<SendHalf, 20>},
    Abuse{"200 connections", microseconds(10000), false, begin<Ask, 200>},
    Abuse{"10 clients that never read", microseconds(1000), false, begin<NeverRead, 10, 2048>},
    Abuse{"all 256 function codes", microseconds(100), false, begin<AskEveryFunction, 4>},
    Abuse{"random frames", microseconds(500), false, begin<SendNoise, 4>},
    Abuse{"10 clients that ask without pause", microseconds(0), true, begin<AskWithoutPause, 10>},
};

}  // namespace

std::span<const Abuse> abuses() { return kAbuses; }

Abused::Abused(const Abuse& abuse, int port) : thread_([this, abuse, port] { run(abuse, port); }) {}

Abused::~Abused() {
  {
    const std::lock_guard lock(mutex_);
    is_ended_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

void Abused::run(const Abuse& abuse, int port) {
  const auto abusers = abuse.begin(port);
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, abuse.pause, [this] { return is_ended_; })) {
    lock.unlock();
    abusers->act();
    ++acts_;
    lock.lock();
  }
}

}  // namespace orbwatch::app::tests
