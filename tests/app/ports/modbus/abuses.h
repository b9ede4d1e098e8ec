#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <ostream>
#include <span>
#include <string_view>
#include <thread>

namespace orbwatch::app::tests {

/// Clients that a server must bear.
class Abusers {
 public:
  virtual ~Abusers() = default;

  /// Each of them does one thing. Does not wait for the server.
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

std::span<const Abuse> abuses();

/// An abuse that goes on while this lives.
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

}  // namespace orbwatch::app::tests
