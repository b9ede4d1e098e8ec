// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <string>

#include "app/ports/dds/participant/entity.h"
#include "tests/support/loopback_dds.h"

namespace orbwatch::app::tests {

/// A private DDS network on the loopback interface: two domains of this process that are one domain
/// on the wire. Sink and reader get one each, so that all samples cross UDP like between two
/// machines, and a tag isolates it from other tests. The sink's side accepts no sample above 1 MB.
class DdsNetwork {
 public:
  static constexpr int kSinkDomain = 1;
  static constexpr int kReaderDomain = 2;

  DdsNetwork()
      : sink_domain_(dds_create_domain(
            kSinkDomain,
            configuration("<Internal><MaxSampleSize>1MB</MaxSampleSize></Internal>").c_str())),
        reader_domain_(dds_create_domain(kReaderDomain, configuration().c_str())) {}

  bool valid() const { return sink_domain_ && reader_domain_; }

  /// Blocks reception and transmission of the readers' side, like a hung computer, or unblocks
  /// them.
  void hang_readers(bool hung) const {
    ASSERT_EQ(dds_domain_set_deafmute(reader_domain_.get(), hung, hung, DDS_INFINITY),
              DDS_RETCODE_OK);
  }

  /// Configuration of a domain on this network; `more` is inserted into <Domain>.
  static std::string configuration(const std::string& more = "") {
    // Ports of the domains up to 100 are below the ephemeral ports.
    const std::string domain = std::to_string(1 + getpid() % 100);
    return orbwatch::tests::loopback_dds(more,
                                         "<ExternalDomainId>" + domain + "</ExternalDomainId>");
  }

 private:
  dds::Entity sink_domain_;
  dds::Entity reader_domain_;
};

/// Repeats `step` until it returns true; false: not within a generous time limit.
inline bool eventually(const std::function<bool()>& step) {
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!step()) {
    if (std::chrono::steady_clock::now() > give_up) return false;
  }
  return true;
}

}  // namespace orbwatch::app::tests
