// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/listeners.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "app/state/private_file.h"
#include "tests/app/ports/web/tls/pem_files.h"
#include "tests/support/comes_true.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::web::tests {
namespace {

using std::chrono::seconds;

/// Servers with a self-made certificate that is due soon after the start of the test.
class ListenersTest : public testing::Test {
 protected:
  ListenersTest() {
    settings_.enabled = true;
    settings_.port = 0;
    settings_.https_port = 0;
  }
  /// On a busy machine the certificate may be due before it is shown, and is replaced at once.
  void SetUp() override {
    for (seconds left{3}; left < seconds(60); left *= 2) {
      open_with_one_that_is_due_in(left);
      if (HasFatalFailure() || listeners_.certificate_days() < 61) return;
      listeners_.close();
    }
    FAIL() << "no certificate was shown before it was due";
  }
  void open_with_one_that_is_due_in(seconds left) {
    const Credential ending =
        make_credential("ball", CertificateUse::Serve, valid_for(kRenewedBefore + left), nullptr,
                        own_hosts(settings_))
            .value();
    ASSERT_TRUE(write_private(folder_ / "certificate.pem",
                              to_pem(ending.certificate).value() + to_pem(ending.key).value()));
    const auto opened = listeners_.open();
    ASSERT_TRUE(opened) << opened.error().message;
  }
  ServerCertificate kept() const { return kept_certificate(folder_.path()).value().value(); }
  bool becomes_due() const {
    return orbwatch::tests::comes_true([&] { return is_due(kept(), this_second()); });
  }

  const orbwatch::tests::TemporaryFolder folder_;
  WebSettings settings_;
  ServerCounts counts_;
  Listeners listeners_{settings_, folder_.path(),
                       [](const ExchangePtr& exchange) {
                         exchange->answer(error_response(404, "there is nothing here"));
                       },
                       counts_};
};

/// The thread of the live status watches connections; another one waits for the disk.
TEST_F(ListenersTest, WatchingRenewsNoCertificate) {
  const int port = listeners_.https_port();
  ASSERT_TRUE(becomes_due());
  const std::string before = kept().fingerprint;
  listeners_.watch();
  EXPECT_EQ(kept().fingerprint, before);
  EXPECT_LT(listeners_.certificate_days(), 61);
  listeners_.renew_certificate();
  EXPECT_NE(kept().fingerprint, before);
  EXPECT_GT(listeners_.certificate_days(), 820);
  EXPECT_EQ(listeners_.https_port(), port);
  const std::string renewed = kept().fingerprint;
  listeners_.renew_certificate();
  EXPECT_EQ(kept().fingerprint, renewed) << "it is not due";
}

TEST_F(ListenersTest, WhatIsClosedIsNotOpenedByARenewal) {
  ASSERT_TRUE(becomes_due());
  const std::string before = kept().fingerprint;
  listeners_.close();
  listeners_.renew_certificate();
  EXPECT_EQ(listeners_.https_port(), 0);
  EXPECT_EQ(kept().fingerprint, before);
}

}  // namespace
}  // namespace orbwatch::app::web::tests
