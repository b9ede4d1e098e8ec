#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "hal/thread/file_descriptor.h"
#include "tests/support/reference_data.h"

namespace orbwatch::tests {

/// A network of its own with nothing but a loopback interface that is up, like that of a
/// computer alone. It has no name, so that nothing stays when the test dies, and lasts as long as
/// this or a thread, a socket or a program inside.
class NetworkNamespace {
 public:
  /// Whether this process may make any, which takes root.
  static bool allowed();

  /// Throws std::runtime_error when it may not.
  NetworkNamespace();

  /// Does `work` on a thread inside and waits for it. Threads, sockets and programs that it starts
  /// stay inside. What it throws comes out.
  void run(const std::function<void()>& work) const;

  /// For `ip ... netns PATH`, as long as this lives.
  std::string path() const;

 private:
  hal::FileDescriptor descriptor_;
};

/// A cable between two namespaces: an interface `wire` in each, of 1500 bytes per packet, with the
/// addresses kLeft and kRight.
class Cable {
 public:
  static constexpr const char* kLeft = "10.77.0.1";
  static constexpr const char* kRight = "10.77.0.2";

  Cable(const NetworkNamespace& left, const NetworkNamespace& right);

  /// Pulls the plug on the right: left sees that nobody is there any more.
  void pull() const;
  void plug() const;

  /// Gives the left end this address instead of the one it had.
  void readdress(const std::string& address) const;

 private:
  const NetworkNamespace& left_;
  const NetworkNamespace& right_;
};

/// Until the interface `wire` of the calling thread's namespace carries packets: the system says so
/// up to a second after both ends are up, and who looks for interfaces before does not see it.
/// Throws std::runtime_error when it never does.
void wait_for_carrier();

/// Runs a command line of `ip` in the namespace of the calling thread. Throws std::runtime_error
/// when it fails.
void ip(const std::string& arguments);

}  // namespace orbwatch::tests

/// Ends the test when it may not make networks: skipped with the reason, or failed in acceptance
/// mode.
#define ORBWATCH_REQUIRE_NETWORK_NAMESPACES()                                               \
  do {                                                                                      \
    if (!orbwatch::tests::NetworkNamespace::allowed()) {                                    \
      if (orbwatch::tests::acceptance_mode()) FAIL() << "missing: root, to make a network"; \
      GTEST_SKIP() << "skipped, missing: root, to make a network";                          \
    }                                                                                       \
  } while (false)
