// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/tls/server_certificate.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "app/state/private_file.h"
#include "tests/app/ports/web/tls/pem_files.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::web::tests {
namespace {

namespace fs = std::filesystem;
using std::chrono::days;
using std::chrono::seconds;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::vector<std::string> kHosts{"localhost", "127.0.0.1", "::1", "ball.example"};

class ServerCertificateTest : public testing::Test {
 protected:
  Result<ServerCertificate> self_made(const std::vector<std::string>& hosts = kHosts) const {
    return self_made_certificate(folder.path(), hosts, now);
  }
  std::string refusal(const WebSettings& settings) const {
    const auto named = named_certificate(settings, now);
    return named ? "" : named.error().message;
  }

  orbwatch::tests::TemporaryFolder folder;
  std::chrono::sys_seconds now = this_second();
  const fs::path file = folder.path() / "certificate.pem";
};

TEST_F(ServerCertificateTest, ASelfMadeOneIsKeptForItsOwnerOnly) {
  const auto made = self_made();
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_TRUE(made->is_self_made);
  const auto again = self_made();
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->fingerprint, made->fingerprint);
  const auto kept = kept_certificate(folder.path());
  ASSERT_TRUE(kept && *kept);
  EXPECT_EQ((*kept)->fingerprint, made->fingerprint);
  struct stat about {};
  ASSERT_EQ(::stat(file.c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 07777U, 0600U);
  EXPECT_THAT(certificate_text(*made), AllOf(HasSubstr("self-made"), HasSubstr(made->fingerprint)));
}

TEST_F(ServerCertificateTest, ItIsForTheHostsAndNoOthers) {
  const auto made = self_made();
  ASSERT_TRUE(made) << made.error().message;
  const auto certificate = certificate_from_pem(made->pem.certificate);
  ASSERT_TRUE(certificate);
  for (const std::string& host : kHosts) EXPECT_TRUE(is_for_host(*certificate, host)) << host;
  for (const char* other : {"evil.example", "10.0.0.9", "::2", ""}) {
    EXPECT_FALSE(is_for_host(*certificate, other)) << other;
  }
  EXPECT_NE(self_made({"localhost", "other.example"})->fingerprint, made->fingerprint);
}

TEST_F(ServerCertificateTest, ItIsReplacedBeforeItsEnd) {
  const auto made = self_made();
  ASSERT_TRUE(made) << made.error().message;
  const auto end = made->validity.until;
  EXPECT_LE(end - made->validity.from, days(825)) << "Apple's limit";
  EXPECT_FALSE(is_due(*made, end - kRenewedBefore - seconds(1)));
  now = end - kRenewedBefore;
  EXPECT_TRUE(is_due(*made, now));
  const auto next = self_made();
  ASSERT_TRUE(next) << next.error().message;
  EXPECT_NE(next->fingerprint, made->fingerprint);
  EXPECT_FALSE(is_due(*next, now));
}

TEST_F(ServerCertificateTest, AClockThatStartsInThePastReplacesNone) {
  const auto made = self_made();
  ASSERT_TRUE(made) << made.error().message;
  now -= days(3000);
  EXPECT_EQ(self_made()->fingerprint, made->fingerprint);
}

TEST_F(ServerCertificateTest, OneOfTheFutureIsReplacedOnceTheClockIsRight) {
  const auto right = now;
  now += days(26000);
  const auto made = self_made();
  ASSERT_TRUE(made) << made.error().message;
  now = right;
  EXPECT_FALSE(is_due(*made, now, ClockState::Unsure)) << "the clock may be behind";
  EXPECT_EQ(self_made()->fingerprint, made->fingerprint);
  EXPECT_TRUE(is_due(*made, now, ClockState::Synchronised));
  const auto next = self_made_certificate(folder.path(), kHosts, now, ClockState::Synchronised);
  ASSERT_TRUE(next) << next.error().message;
  EXPECT_NE(next->fingerprint, made->fingerprint);
  EXPECT_FALSE(is_due(*next, now, ClockState::Synchronised));
  EXPECT_FALSE(is_due(*next, now - days(1), ClockState::Synchronised)) << "clocks differ";
}

TEST_F(ServerCertificateTest, ADamagedOrOpenFileIsReplaced) {
  const auto made = self_made();
  ASSERT_TRUE(made) << made.error().message;
  fs::resize_file(file, fs::file_size(file) / 2);
  EXPECT_FALSE(kept_certificate(folder.path()));
  const auto next = self_made();
  ASSERT_TRUE(next) << next.error().message;
  EXPECT_NE(next->fingerprint, made->fingerprint);
  ::chmod(file.c_str(), 0644);
  const auto third = self_made();
  ASSERT_TRUE(third) << third.error().message;
  EXPECT_NE(third->fingerprint, next->fingerprint) << "others may know its key";
}

TEST_F(ServerCertificateTest, WithoutAFolderThereIsNone) {
  const auto made = self_made_certificate({}, kHosts, now);
  ASSERT_FALSE(made);
  EXPECT_THAT(made.error().message, HasSubstr("no state folder"));
}

TEST_F(ServerCertificateTest, AnOwnOneIsShownWithItsIssuers) {
  const PemFiles files(folder.path());
  const auto named = named_certificate(files.settings(), now);
  ASSERT_TRUE(named) << named.error().message;
  EXPECT_FALSE(named->is_self_made);
  EXPECT_EQ(named->fingerprint, fingerprint_of(files.own.certificate));
  EXPECT_THAT(named->pem.certificate, HasSubstr(to_pem(files.authority.certificate).value()));
  EXPECT_FALSE(is_due(*named, named->validity.until)) << "nobody but its owner replaces it";
  EXPECT_FALSE(fs::exists(file));
}

TEST_F(ServerCertificateTest, AnErrorNamesTheFileAndWhatIsWrong) {
  const PemFiles files(folder.path());
  const WebSettings settings = files.settings();
  const std::string certificate = settings.certificate.string(), key = settings.key.string();
  const Credential other =
      make_credential("other", CertificateUse::Serve, valid_for(days(90))).value();

  write_pem(files.key, to_pem(other.key).value());
  EXPECT_THAT(refusal(settings),
              AllOf(HasSubstr(key), HasSubstr("is not the key of " + certificate)));
  write_pem(files.key, to_pem(files.own.key).value(), 0644);
  EXPECT_THAT(refusal(settings), AllOf(HasSubstr(key), HasSubstr("is world-readable")));
  write_pem(files.key, to_pem(files.own.certificate).value());
  EXPECT_THAT(refusal(settings), AllOf(HasSubstr(key), HasSubstr("is not a private key")));
  fs::remove(files.key);
  EXPECT_THAT(refusal(settings), AllOf(HasSubstr(key), HasSubstr("cannot be read")));
  write_pem(files.key, to_pem(files.own.key).value());
  EXPECT_EQ(refusal(settings), "");

  write_pem(files.certificate, "no PEM\n");
  EXPECT_THAT(refusal(settings), AllOf(HasSubstr(certificate), HasSubstr("is not a certificate")));
  fs::remove(files.certificate);
  fs::create_directory(files.certificate);
  EXPECT_THAT(refusal(settings), AllOf(HasSubstr(certificate), HasSubstr("directory")));
  fs::remove(files.certificate);
  ASSERT_EQ(::mkfifo(files.certificate.c_str(), 0600), 0);
  EXPECT_THAT(refusal(settings), AllOf(HasSubstr(certificate), HasSubstr("pipe")));
}

TEST_F(ServerCertificateTest, AnOwnOneThatIsNotValidNowIsRefusedUnlessTheClockIsNotTrusted) {
  const PemFiles files(folder.path(), {now - days(30), now - seconds(1)});
  EXPECT_THAT(refusal(files.settings()), AllOf(HasSubstr("expired on"), HasSubstr("be renewed")));
  EXPECT_TRUE(named_certificate(files.settings(), now_for(Dates::Ignored)));
  const PemFiles future(folder.path(), {now + days(1), now + days(30)});
  EXPECT_THAT(refusal(future.settings()), HasSubstr("check this computer's clock"));
}

TEST(OwnHosts, AreTheNamesAndWhatBrowsersCallIt) {
  WebSettings settings;
  settings.address = "0.0.0.0";
  settings.names = {"ball.example", "10.0.0.7", "localhost", "a b"};
  const auto hosts = own_hosts(settings);
  for (const char* host : {"localhost", "127.0.0.1", "::1", "ball.example", "10.0.0.7"}) {
    EXPECT_EQ(std::ranges::count(hosts, host), 1) << host;
  }
  EXPECT_THAT(hosts, AllOf(Not(testing::Contains("0.0.0.0")), Not(testing::Contains("a b"))));
  settings.address = "192.168.1.20";
  EXPECT_THAT(own_hosts(settings), testing::Contains("192.168.1.20"));
}

}  // namespace
}  // namespace orbwatch::app::web::tests
