// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "hal/thread/file_descriptor.h"
#include "tests/support/reference_data.h"

namespace orbwatch::tests {

/// A network namespace with nothing but an active loopback interface, like that of an isolated
/// computer. It has no name, so that nothing remains when the test crashes, and lasts as long as
/// this object or a thread, a socket or a program inside.
class NetworkNamespace {
 public:
  /// True if this process may create namespaces, which requires root.
  static bool allowed();

  /// Throws std::runtime_error without that permission.
  NetworkNamespace();

  /// Runs `work` on a thread inside and waits for it. Threads, sockets and programs that it starts
  /// stay inside. Rethrows its exceptions.
  void run(const std::function<void()>& work) const;

  /// Path for `ip ... netns PATH`, valid for the lifetime of this object.
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

  /// Disconnects the right end: the left one loses its carrier.
  void pull() const;
  void plug() const;

  /// Replaces the left end's address.
  void readdress(const std::string& address) const;

 private:
  const NetworkNamespace& left_;
  const NetworkNamespace& right_;
};

/// Waits until the interface `wire` of the calling thread's namespace has a carrier: the system
/// reports it up to a second after both ends are up, and a search for interfaces before that does
/// not find it. Throws std::runtime_error when it never does.
void wait_for_carrier();

/// Runs a command line of `ip` in the namespace of the calling thread. Throws std::runtime_error
/// when it fails.
void ip(const std::string& arguments);

}  // namespace orbwatch::tests

/// Ends the test when it may not create networks: skipped with the reason, or failed in acceptance
/// mode.
#define ORBWATCH_REQUIRE_NETWORK_NAMESPACES()                                               \
  do {                                                                                      \
    if (!orbwatch::tests::NetworkNamespace::allowed()) {                                    \
      if (orbwatch::tests::acceptance_mode()) FAIL() << "missing: root, to make a network"; \
      GTEST_SKIP() << "skipped, missing: root, to make a network";                          \
    }                                                                                       \
  } while (false)
