// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

#include "app/ports/dds/dds_sink.h"
#include "tests/app/ports/dds/dds_network.h"
#include "tests/app/ports/dds/test_status.h"
#include "tests/app/ports/dds/test_views.h"
#include "tests/support/network_namespace.h"

namespace orbwatch::app::tests {

/// Domain of every test here, because each has a separate network.
inline constexpr int kDomain = 3;

/// A receive buffer for pictures, as far as the system grants it.
inline constexpr const char* kReceiveBuffer = "8388608";

/// The networks of orbwatch and of the readers, and the name of the shipped settings for them: one
/// network with only the loopback interface, or two connected by a cable.
class ShippedNetwork {
 public:
  enum class Kind { SameHost, Lan };

  explicit ShippedNetwork(Kind kind)
      : profile_(kind == Kind::SameHost ? "same-host.xml" : "lan.xml") {
    if (kind == Kind::SameHost) return;
    readers_.emplace();
    cable_.emplace(writers_, *readers_);
  }

  const orbwatch::tests::NetworkNamespace& writers() const { return writers_; }
  const orbwatch::tests::NetworkNamespace& readers() const {
    return readers_ ? *readers_ : writers_;
  }
  const orbwatch::tests::Cable& cable() const { return cable_.value(); }

  /// The shipped profile, for CYCLONEDDS_URI.
  std::string profile() const { return "file://" ORBWATCH_SOURCE_DIR "/platform/dds/" + profile_; }

  /// Starts the sink and waits until it has joined the domain.
  void start(dds::DdsSink& sink) const {
    setenv("CYCLONEDDS_URI", profile().c_str(), 1);
    writers_.run([&sink] {
      const auto started = sink.start();
      EXPECT_TRUE(started) << started.error().message;
    });
    EXPECT_TRUE(eventually([&sink] { return sink.statistics().joins == 1; }));
  }

 private:
  const std::string profile_;
  orbwatch::tests::NetworkNamespace writers_;
  std::optional<orbwatch::tests::NetworkNamespace> readers_;
  std::optional<orbwatch::tests::Cable> cable_;
};

}  // namespace orbwatch::app::tests
