// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <ostream>
#include <string_view>
#include <thread>
#include <vector>

#include "tests/support/raw_client.h"

namespace orbwatch::tests {

/// Clients that a server must withstand.
class Abusers {
 public:
  virtual ~Abusers() = default;

  /// Performs one act per client. Does not wait for the server.
  virtual void act() = 0;
};

/// One way to abuse a server. Its clients come from 127.0.0.2.
struct Abuse {
  std::string_view name;
  std::chrono::microseconds pause;  ///< between acts
  bool is_allowed;                  ///< the server neither refuses requests nor ends connections
  std::unique_ptr<Abusers> (*begin)(int port);
};

inline void PrintTo(const Abuse& abuse, std::ostream* out) { *out << abuse.name; }

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
  /// Bytes received since it connected.
  long received() const { return received_; }
  void leave() { *this = Returning(port_, receive_buffer_); }

 private:
  int port_;
  int receive_buffer_;
  std::size_t sent_ = 0;  ///< bytes of a message that was not sent completely
  long received_ = 0;
  std::unique_ptr<RawClient> client_;
};

/// A number of clients with the same behaviour.
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

/// For `Abuse::begin`: kCount clients, with receive buffers of kReceiveBuffer bytes if that is not
/// 0.
template <class Behaviour, std::size_t kCount, int kReceiveBuffer = 0>
std::unique_ptr<Abusers> begin_crowd(int port) {
  return std::make_unique<Crowd<Behaviour>>(port, kCount, kReceiveBuffer);
}

/// An abuse that lasts for the lifetime of this object.
class Abused {
 public:
  Abused(const Abuse& abuse, int port);
  ~Abused();
  Abused(const Abused&) = delete;
  Abused& operator=(const Abused&) = delete;

  std::uint64_t acts() const { return acts_; }

 private:
  void run(const Abuse& abuse, int port);

  std::atomic<std::uint64_t> acts_{0};
  std::mutex mutex_;
  std::condition_variable ended_;
  bool is_ended_ = false;
  std::thread thread_;
};

}  // namespace orbwatch::tests
