// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <poll.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "tests/support/on_a_thread.h"
#include "tests/support/reference_data.h"

namespace orbwatch::tests {

/// Runs `work` on a thread with a private /run, so that there is no journal, and waits for it.
/// Programs that it starts have the same /run. False: the system does not allow that.
inline bool without_a_journal(const std::function<void()>& work) {
  bool allowed = false;
  on_a_thread([&] {
    allowed = ::unshare(CLONE_NEWNS) == 0 &&
              ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
              ::mount("tmpfs", "/run", "tmpfs", 0, nullptr) == 0;
    if (allowed) work();
  });
  return allowed;
}

/// The variable that systemd sets in the environment of a service whose stderr is this file.
inline std::string journal_stream_of(const struct stat& file) {
  return std::to_string(file.st_dev) + ":" + std::to_string(file.st_ino);
}

/// Replacement for journald within without_a_journal(): receives entries of its native protocol,
/// https://systemd.io/JOURNAL_NATIVE_PROTOCOL/.
class JournalSocket {
 public:
  using Entry = std::map<std::string, std::string>;

  JournalSocket() : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    std::filesystem::create_directories("/run/systemd/journal");
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strcpy(address.sun_path, "/run/systemd/journal/socket");
    EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  }
  JournalSocket(const JournalSocket&) = delete;
  JournalSocket& operator=(const JournalSocket&) = delete;
  ~JournalSocket() { ::close(socket_); }

  /// The next entry in the form sent; nullopt after a minute without any.
  std::optional<std::string> next_sent() const {
    pollfd waiting{socket_, POLLIN, 0};
    if (::poll(&waiting, 1, 60'000) <= 0) return std::nullopt;
    std::string sent(std::size_t{1} << 16, '\0');
    const auto size = ::recv(socket_, sent.data(), sent.size(), 0);
    sent.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return sent;
  }

  /// The fields of an entry. A duplicate field, or one that is not valid in the protocol, fails the
  /// test.
  static Entry fields(std::string_view sent) {
    Entry entry;
    while (!sent.empty()) {
      const auto end = sent.find('\n');
      if (end == std::string_view::npos) {
        ADD_FAILURE() << "no end of a field: " << sent;
        break;
      }
      const std::string_view line = sent.substr(0, end);
      sent.remove_prefix(end + 1);
      const auto equals = line.find('=');
      const std::string name(line.substr(0, equals));
      EXPECT_FALSE(entry.contains(name)) << name;
      if (equals != std::string_view::npos) {
        entry[name] = line.substr(equals + 1);
        continue;
      }
      // The binary form: 64 bits of size, little-endian, the bytes, a line feed.
      std::uint64_t size = 0;
      if (sent.size() < sizeof size + 1) {
        ADD_FAILURE() << "no size of " << name;
        break;
      }
      for (std::size_t i = 0; i < sizeof size; ++i) {
        size |= std::uint64_t{static_cast<unsigned char>(sent[i])} << (8 * i);
      }
      sent.remove_prefix(sizeof size);
      if (size >= sent.size() || sent[size] != '\n') {
        ADD_FAILURE() << "wrong size of " << name;
        break;
      }
      entry[name] = sent.substr(0, size);
      sent.remove_prefix(size + 1);
    }
    return entry;
  }

  /// Receives entries until `is_wanted`; fails after a minute without any entry, or a thousand
  /// others.
  Entry await(const std::function<bool(const Entry&)>& is_wanted) const {
    for (int i = 0; i < 1000; ++i) {
      const auto sent = next_sent();
      if (!sent) break;
      const Entry entry = fields(*sent);
      if (is_wanted(entry)) return entry;
    }
    ADD_FAILURE() << "no such entry in the journal";
    return {};
  }

 private:
  const int socket_;
};

}  // namespace orbwatch::tests

/// Runs `work` in without_a_journal(), or ends the test: skipped with the reason, or failed in
/// acceptance mode.
#define ORBWATCH_WITHOUT_A_JOURNAL(...)                                                     \
  do {                                                                                      \
    if (!orbwatch::tests::without_a_journal(__VA_ARGS__)) {                                 \
      if (orbwatch::tests::acceptance_mode()) FAIL() << "missing: root, to mount a folder"; \
      GTEST_SKIP() << "skipped, missing: root, to mount a folder";                          \
    }                                                                                       \
  } while (false)
