// SPDX-License-Identifier: Apache-2.0
/// Checks keys and documents with the program of OpenSSL.
#include "app/cli/keys/keystore.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <map>

#include "app/ports/dds/security/enclave.h"
#include "app/ports/dds/topics/topic_names.h"
#include "tests/app/ports/dds/security/openssl_program.h"
#include "tests/app/ports/dds/security/test_keystore.h"

namespace orbwatch::app::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using tests::keystore_request;
using tests::make_keystore;
using tests::this_second;

/// Contents of every file below a folder.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files[fs::relative(entry.path(), folder)] = tests::text_of_file(entry.path());
    }
  }
  return files;
}

unsigned mode(const fs::path& path) {
  struct stat status {};
  EXPECT_EQ(::stat(path.c_str(), &status), 0) << path;
  return status.st_mode & 0777U;
}

class KeystoreTest : public testing::Test {
 protected:
  KeystoreRequest request() const { return keystore_request(folder_ / "keys"); }
  fs::path file(const std::string& name) const { return folder_ / "keys" / name; }
  dds::EnclaveFiles enclave(const std::string& name) const {
    return dds::EnclaveFiles(enclave_folder(folder_ / "keys", name));
  }

  void expect_refused(const KeystoreRequest& request, const std::string& reason) const {
    const auto before = contents(folder_.path());
    const auto made = make_keys(request, this_second());
    ASSERT_FALSE(made) << reason;
    EXPECT_THAT(made.error().message, HasSubstr(reason));
    EXPECT_EQ(contents(folder_.path()), before);
  }

  orbwatch::tests::TemporaryFolder folder_;
  tests::OpensslProgram openssl_;
};

TEST_F(KeystoreTest, CertificatesAreThoseOfTheirKeysAndAuthorities) {
  make_keystore(request());
  for (const std::string name : {"appliance", "subscriber"}) {
    const dds::EnclaveFiles files = enclave(name);
    EXPECT_EQ(
        openssl_.run({"verify", "-x509_strict", "-CAfile", files.identity_ca, files.certificate}),
        0)
        << openssl_.said;
    EXPECT_EQ(openssl_.run(
                  {"x509", "-in", files.certificate, "-noout", "-subject", "-nameopt", "RFC2253"}),
              0);
    EXPECT_EQ(openssl_.said, "subject=CN=" + name + "\n");
    EXPECT_EQ(openssl_.run({"pkey", "-in", files.key, "-pubout"}), 0) << openssl_.said;
    const std::string of_key = openssl_.said;
    EXPECT_EQ(openssl_.run({"x509", "-in", files.certificate, "-noout", "-pubkey"}), 0);
    EXPECT_EQ(openssl_.said, of_key);
    EXPECT_EQ(openssl_.run({"pkey", "-in", files.key, "-noout", "-text"}), 0);
    EXPECT_THAT(openssl_.said, HasSubstr("prime256v1"));
  }
  EXPECT_NE(tests::text_of_file(enclave("appliance").key),
            tests::text_of_file(enclave("subscriber").key));
  // The other authority does not issue identities.
  EXPECT_NE(openssl_.run({"verify", "-CAfile", enclave("subscriber").permissions_ca,
                          enclave("subscriber").certificate}),
            0);
}

TEST_F(KeystoreTest, DocumentsAreSignedByTheAuthorityForThem) {
  make_keystore(request());
  for (const std::string name : {"appliance", "subscriber"}) {
    const dds::EnclaveFiles files = enclave(name);
    for (const fs::path& document : {files.governance, files.permissions}) {
      const std::vector<std::string> verify{"smime", "-verify", "-text",
                                            "-in",   document,  "-CAfile"};
      auto arguments = verify;
      arguments.insert(arguments.end(), {files.permissions_ca, "-out", folder_ / "text"});
      EXPECT_EQ(openssl_.run(arguments), 0) << openssl_.said;
      // S/MIME ends lines with CR LF, like mail.
      std::string text = tests::text_of_file(folder_ / "text");
      std::erase(text, '\r');
      EXPECT_EQ(text, tests::text_of_file(fs::path(document).replace_extension(".xml")));

      arguments = verify;
      arguments.insert(arguments.end(), {files.identity_ca});
      EXPECT_NE(openssl_.run(arguments), 0) << "signed by who issues identities";
    }
  }
}

TEST_F(KeystoreTest, NoParticipantCanSignItsOwnPermissions) {
  make_keystore(request());
  const dds::EnclaveFiles files = enclave("subscriber");
  const fs::path xml = fs::path(files.permissions).replace_extension(".xml");
  ASSERT_EQ(openssl_.run({"smime", "-sign", "-text", "-in", xml, "-signer", files.certificate,
                          "-inkey", files.key, "-out", folder_ / "forged"}),
            0)
      << openssl_.said;
  for (const fs::path& authority : {files.permissions_ca, files.identity_ca}) {
    // Verifies like Cyclone DDS 0.10.2, which accepts a chain of certificates like the authority.
    EXPECT_NE(openssl_.run(
                  {"smime", "-verify", "-text", "-in", folder_ / "forged", "-CAfile", authority}),
              0)
        << authority;
  }
}

TEST_F(KeystoreTest, IsValidForTheDaysAskedFor) {
  auto asked = request();
  asked.days = 30;
  make_keystore(asked);
  constexpr long kDay = 86400;
  for (const fs::path& certificate :
       {enclave("appliance").certificate, enclave("appliance").identity_ca,
        enclave("appliance").permissions_ca}) {
    EXPECT_EQ(openssl_.run({"x509", "-in", certificate, "-noout", "-checkend",
                            std::to_string(30 * kDay - 600)}),
              0);
    EXPECT_NE(openssl_.run({"x509", "-in", certificate, "-noout", "-checkend",
                            std::to_string(30 * kDay + 1)}),
              0);
  }
}

TEST_F(KeystoreTest, KeysAreTheirOwnersOnly) {
  const mode_t before = ::umask(0);
  make_keystore(request());
  ::umask(before);
  EXPECT_EQ(mode(folder_ / "keys"), 0700U);
  for (const char* key : {"private/identity_ca.key.pem", "private/permissions_ca.key.pem",
                          "enclaves/appliance/key.pem", "enclaves/subscriber/key.pem"}) {
    EXPECT_EQ(mode(file(key)), 0600U) << key;
  }
  for (const char* open : {"enclaves/appliance/cert.pem", "enclaves/appliance/permissions.p7s"}) {
    EXPECT_EQ(mode(file(open)), 0644U) << open;
  }
}

TEST_F(KeystoreTest, IsNotOverwrittenUnlessAskedFor) {
  make_keystore(request());
  expect_refused(request(), "holds keys already");
  auto again = request();
  again.subscribers = {"subscriber"};
  expect_refused(again, "enclaves/subscriber: is there already");

  const auto before = contents(folder_ / "keys");
  again.replace = true;
  make_keystore(again);
  const auto one_new = contents(folder_ / "keys");
  for (const auto& [name, text] : before) {
    const bool of_subscriber = name.starts_with("enclaves/subscriber/");
    const bool is_new =
        of_subscriber && (name.ends_with("/key.pem") || name.ends_with("/cert.pem"));
    if (is_new) {
      EXPECT_NE(one_new.at(name), text) << name;
    }
    if (!of_subscriber) {
      EXPECT_EQ(one_new.at(name), text) << name;
    }
  }

  again.subscribers.clear();
  make_keystore(again);
  const auto all_new = contents(folder_ / "keys");
  for (const char* name : {"private/identity_ca.key.pem", "enclaves/appliance/key.pem"}) {
    EXPECT_NE(all_new.at(name), before.at(name)) << name;
  }
  EXPECT_EQ(folder_.files(), 1) << "the old one is gone";
}

TEST_F(KeystoreTest, SubscribersAreAddedByTheSameAuthorities) {
  make_keystore(request());
  const auto before = contents(folder_ / "keys");
  auto more = request();
  more.subscribers = {"plc", "office-2"};
  more.days = 100'000;
  make_keystore(more);
  auto after = contents(folder_ / "keys");
  for (const std::string name : {"plc", "office-2"}) {
    const dds::EnclaveFiles files = enclave(name);
    EXPECT_EQ(openssl_.run(
                  {"verify", "-CAfile", file("private/identity_ca.cert.pem"), files.certificate}),
              0)
        << openssl_.said;
    EXPECT_TRUE(check_enclave(files, 1, this_second()));
    // The certificate must not be valid for longer than the authority itself.
    const auto ends = validity_of(*read_certificate(files.certificate))->until;
    EXPECT_EQ(ends, validity_of(*read_certificate(files.identity_ca))->until);
    std::erase_if(after, [&](const auto& entry) {
      return entry.first.starts_with("enclaves/" + name + "/");
    });
  }
  EXPECT_EQ(after, before);
}

TEST_F(KeystoreTest, RefusesWhatDoesNotFit) {
  make_keystore(request());
  auto other = request();
  other.subscribers = {"plc"};
  other.domains = {10, 10};
  expect_refused(other, "another domain or prefix");
  other = request();
  other.subscribers = {"plc"};
  other.bulk_topics = bulk_topics("other");
  expect_refused(other, "another domain or prefix");
  for (const std::string name : {"", "a/b", "..", "a b", "<", "\xC3\xA9", "appliance"}) {
    other = request();
    other.subscribers = {name};
    expect_refused(other, "subscriber \"" + name + "\"");
  }
  other.subscribers = {"twice", "twice"};
  expect_refused(other, "\"twice\": the name is taken");
  other.subscribers = {std::string(65, 'a')};
  expect_refused(other, "1 to 64");

  fs::remove(file("private/permissions_ca.key.pem"));
  other.subscribers = {"plc"};
  expect_refused(other, "permissions_ca.key.pem: cannot be read: No such file");
}

TEST_F(KeystoreTest, AddsSubscribersToOneOfAnEarlierVersion) {
  auto earlier = request();
  for (auto* topics : {&earlier.appliance.publish, &earlier.appliance.subscribe}) {
    std::erase(*topics, dds::kApplianceTopic);
    std::erase(*topics, dds::kThumbnailTopic);
  }
  make_keystore(earlier);
  auto more = request();
  more.subscribers = {"plc"};
  const auto made = make_keys(more, tests::this_second());
  EXPECT_TRUE(made) << made.error().message;
}

TEST_F(KeystoreTest, LeavesOtherFilesAlone) {
  fs::create_directory(folder_ / "keys");
  tests::write_text(folder_ / "keys" / "diary", "private");
  auto replace = request();
  replace.replace = true;
  expect_refused(replace, "there is something in it already");
  expect_refused(request(), "there is something in it already");

  auto nowhere = request();
  nowhere.folder = folder_ / "keys" / "diary" / "below";
  expect_refused(nowhere, "below: cannot be made");
}

TEST_F(KeystoreTest, MakesItsFolderAndThoseAbove) {
  auto deep = request();
  deep.folder = folder_.path() / "a" / "b" / "";
  make_keystore(deep);
  EXPECT_TRUE(fs::exists(folder_.path() / "a" / "b" / "enclaves" / "appliance" / "cert.pem"));
}

}  // namespace
}  // namespace orbwatch::app::cli
