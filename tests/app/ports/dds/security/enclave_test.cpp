// SPDX-License-Identifier: Apache-2.0
/// Errors for unusable files.
#include "app/ports/dds/security/enclave.h"

#include <gmock/gmock.h>

#include <functional>

#include "app/ports/dds/participant/participant.h"
#include "app/ports/dds/security/key_file.h"
#include "app/ports/dds/security/signed_document.h"
#include "tests/app/ports/dds/security/openssl_program.h"
#include "tests/app/ports/dds/security/test_keystore.h"

namespace orbwatch::app::dds {
namespace {

namespace fs = std::filesystem;
using cli::enclave_folder;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using tests::keystore_request;
using tests::make_keystore;
using tests::this_second;

constexpr int kDomain = 4;

/// Messages name the files behind links.
EnclaveFiles files_of(const fs::path& keystore, const std::string& name) {
  return EnclaveFiles(fs::canonical(enclave_folder(keystore, name)));
}

class EnclaveTest : public testing::Test {
 protected:
  EnclaveTest()
      : keystore_(make_keystore(keystore_request(folder_ / "keys"))),
        files_(files_of(keystore_, "subscriber")) {}

  /// Expects one line with the file and the reason, also when joining.
  void expect_refused(const fs::path& file, const std::string& reason, int domain = kDomain) const {
    const auto checked = check_enclave(files_, domain, this_second());
    ASSERT_FALSE(checked) << file << ' ' << reason;
    EXPECT_THAT(checked.error().message,
                AllOf(HasSubstr(file.string() + ": "), HasSubstr(reason), Not(HasSubstr("\n"))));
    const auto joined = Participant::join(domain, SecuritySettings{files_.key.parent_path()});
    ASSERT_FALSE(joined);
    EXPECT_EQ(joined.error().message, "DDS security: " + checked.error().message);
  }

  /// Writes `text`, signed by the keystore's authority, to `file`.
  void sign(const fs::path& file, const std::string& text) const {
    const auto certificate = read_certificate(keystore_ / "private" / "permissions_ca.cert.pem");
    auto key = read_key(keystore_ / "private" / "permissions_ca.key.pem");
    ASSERT_TRUE(key && certificate);
    ASSERT_TRUE(X509_up_ref(certificate->get()));
    const Credential signer{std::move(*key), Certificate(certificate->get())};
    tests::write_text(file, sign_document(text, signer).value());
  }

  orbwatch::tests::TemporaryFolder folder_;
  fs::path keystore_;
  EnclaveFiles files_;
};

TEST_F(EnclaveTest, AcceptsWhatTheKeystoreMakes) {
  for (const std::string name : {"appliance", "subscriber"}) {
    const auto checked =
        check_enclave(EnclaveFiles(enclave_folder(keystore_, name)), kDomain, this_second());
    EXPECT_TRUE(checked) << checked.error().message;
  }
}

TEST_F(EnclaveTest, EveryFileIsNeeded) {
  for (const fs::path& file : {files_.identity_ca, files_.permissions_ca, files_.certificate,
                               files_.key, files_.governance, files_.permissions}) {
    const std::string text = tests::text_of_file(file);
    const fs::perms mode = fs::status(file).permissions();
    fs::remove(file);
    expect_refused(file, "cannot be read: No such file or directory");
    fs::create_directory(file);
    expect_refused(file, "cannot be read: Is a directory");
    fs::remove(file);
    tests::write_text(file, text);
    fs::permissions(file, mode);
  }
  EXPECT_TRUE(check_enclave(files_, kDomain, this_second())) << "all are there again";
}

TEST_F(EnclaveTest, DamagedFilesAreNamed) {
  for (const fs::path& file : {files_.identity_ca, files_.permissions_ca, files_.certificate,
                               files_.key, files_.governance, files_.permissions}) {
    const std::string text = tests::text_of_file(file);
    for (const std::string& damaged :
         {std::string(), text.substr(0, text.size() / 2), std::string(1 << 21, 'x'),
          std::string("-----BEGIN CERTIFICATE-----\nAAAA\n-----END CERTIFICATE-----\n")}) {
      tests::write_text(file, damaged);
      expect_refused(file, "");
    }
    tests::write_text(file, text);
  }
  EXPECT_TRUE(check_enclave(files_, kDomain, this_second())) << "all are whole again";
}

TEST_F(EnclaveTest, ChangedDocumentsAreNamed) {
  for (const fs::path& file : {files_.governance, files_.permissions}) {
    const std::string text = tests::text_of_file(file);
    std::string changed = text;
    changed.replace(changed.find("<max>9<"), 7, "<max>8<");
    tests::write_text(file, changed);
    expect_refused(file, "it must be as CN=orbwatch_permissions_ca signed it");
    tests::write_text(file, text);
  }
}

TEST_F(EnclaveTest, DocumentsOfOtherSignersAreNamed) {
  make_keystore(keystore_request(folder_ / "others"));
  const EnclaveFiles others(enclave_folder(folder_ / "others", "subscriber"));
  fs::copy_file(others.permissions, files_.permissions, fs::copy_options::overwrite_existing);
  expect_refused(files_.permissions, "as CN=orbwatch_permissions_ca signed it");
}

TEST_F(EnclaveTest, FilesOfDifferentParticipantsAreNamed) {
  const EnclaveFiles appliance(enclave_folder(keystore_, "appliance"));
  const std::string own_permissions = tests::text_of_file(files_.permissions);
  tests::write_text(files_.permissions, tests::text_of_file(appliance.permissions));
  expect_refused(files_.permissions, "permits nothing to CN=subscriber");
  tests::write_text(files_.permissions, own_permissions);

  tests::write_text(files_.key, tests::text_of_file(appliance.key));
  expect_refused(files_.key, "is not the key of " + files_.certificate.string());
}

TEST_F(EnclaveTest, CertificatesOfAnotherAuthorityAreNamed) {
  make_keystore(keystore_request(folder_ / "others"));
  const EnclaveFiles others(enclave_folder(folder_ / "others", "subscriber"));
  tests::write_text(files_.identity_ca, tests::text_of_file(others.identity_ca));
  expect_refused(files_.certificate, "was not issued by " + files_.identity_ca.string());
}

TEST_F(EnclaveTest, WhatHasExpiredIsNamed) {
  using std::chrono::days;
  auto old = keystore_request(folder_ / "old");
  old.days = 10;
  make_keystore(old, this_second() - days(20));
  files_ = files_of(folder_ / "old", "subscriber");
  expect_refused(files_.identity_ca, "expired on 2");

  old.folder = folder_ / "long";
  old.days = 100;
  const auto keystore = make_keystore(old, this_second() - days(20));
  old.subscribers = {"short"};
  old.days = 10;
  make_keystore(old, this_second() - days(20));
  files_ = files_of(keystore, "short");
  expect_refused(files_.certificate, "expired on 2");
}

TEST_F(EnclaveTest, WhatIsNotValidYetIsNamedWithTheClock) {
  const auto early = this_second() - std::chrono::days(2);
  const auto checked = check_enclave(files_, kDomain, early);
  ASSERT_FALSE(checked);
  EXPECT_THAT(checked.error().message,
              AllOf(HasSubstr("identity_ca.cert.pem: is valid from 2"), HasSubstr("clock")));
}

TEST_F(EnclaveTest, PermissionsEndByThemselves) {
  Grant grant{"CN=subscriber",
              {this_second() - std::chrono::days(9), this_second() - std::chrono::seconds(1)},
              {{0, 9}},
              cli::reader_access("orbwatch")};
  sign(files_.permissions, permissions_document(grant));
  expect_refused(files_.permissions, "expired on 2");
  grant.validity.until += std::chrono::days(1);
  sign(files_.permissions, permissions_document(grant));
  EXPECT_TRUE(check_enclave(files_, kDomain, this_second()));
  grant.domains = {{kDomain + 1, 9}};
  sign(files_.permissions, permissions_document(grant));
  expect_refused(files_.permissions, "is not for domain 4");
  sign(files_.permissions, "<dds><permissions>");
  expect_refused(files_.permissions, "is not XML");
}

TEST_F(EnclaveTest, OtherDomainsAreNamed) {
  expect_refused(files_.governance, "is not for domain 10", 10);
}

TEST_F(EnclaveTest, AKeyThatEverybodyReadsIsNone) {
  fs::permissions(files_.key, fs::perms::others_read, fs::perm_options::add);
  expect_refused(files_.key, "is world-readable");
}

TEST(SignedDocumentTest, OnlyTheSignerItselfCounts) {
  const ValidityPeriod validity{this_second(), this_second() + std::chrono::days(1)};
  const auto authority = make_credential("authority", CertificateUse::SignDocuments, validity);
  ASSERT_TRUE(authority);
  // A holder of a certificate of the authority that may even sign documents.
  const auto holder =
      make_credential("holder", CertificateUse::SignDocuments, validity, &*authority);
  ASSERT_TRUE(holder);
  const auto document = sign_document("text\n", *holder);
  ASSERT_TRUE(document);
  EXPECT_FALSE(verified_document(*document, authority->certificate));
  EXPECT_TRUE(verified_document(*document, holder->certificate));
}

}  // namespace
}  // namespace orbwatch::app::dds
