// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/backup_file.h"

#include <gmock/gmock.h>

#include "app/cli/archive/compression.h"
#include "app/cli/archive/tar.h"
#include "app/cli/backup/placement.h"
#include "app/digest/sha256.h"
#include "tests/app/cli/backup/site.h"

namespace orbwatch::app::cli::backup {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kPassphrase = "correct horse battery";

Backup example() {
  Backup backup;
  backup.manifest = {.version = "0.1.2",
                     .made = "2026-11-28T12:00:00Z",
                     .host = "old-device",
                     .site = "site.toml"};
  backup.files = {{"configuration/site.toml", "rig = \"rig.toml\"\n", 0640},
                  {"state/calibration.toml", "version = 1\n", 0600}};
  backup.secrets = {{"state/users.json", "hash-of-kim", 0600},
                    {"configuration/keys/key.pem", "key-of-kim", 0640}};
  return backup;
}

std::string bytes_of(const Backup& backup, const char* passphrase = kPassphrase) {
  const auto bytes = backup_bytes(backup, passphrase);
  EXPECT_TRUE(bytes) << bytes.error().message;
  return bytes.value_or("");
}

/// The unpacked files of a backup.
Archive unpacked(const std::string& bytes) {
  return decompressed(bytes, kMostBytes)
      .and_then([](const std::string& tar) { return parse_tar(tar); })
      .value_or(Archive{});
}

Result<ReadBackup> packed(const Archive& archive) {
  return tar_of(archive, {})
      .and_then([](const std::string& tar) { return compressed(tar); })
      .and_then([](const std::string& bytes) { return parse_backup(bytes); });
}

std::string refusal_of(const Result<ReadBackup>& read) {
  EXPECT_FALSE(read);
  return read ? "" : read.error().message;
}

/// The manifest of the example with a part replaced.
Archive with_manifest(const std::string& part, const std::string& instead) {
  Archive archive = unpacked(bytes_of(example(), ""));
  const std::size_t at = archive.front().bytes.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  archive.front().bytes.replace(at, part.size(), instead);
  return archive;
}

TEST(BackupFile, KeepsAnyFolderWithBytesAndModes) {
  std::mt19937 random(7);
  for (int round = 0; round < 5; ++round) {
    Device device, other;
    fill_randomly(device, random);
    const auto collected = collect(device.site());
    ASSERT_TRUE(collected) << collected.error().message;
    EXPECT_THAT(collected->manifest.left_out, ElementsAre());
    auto read = parse_backup(bytes_of(*collected));
    ASSERT_TRUE(read) << read.error().message;
    if (!collected->secrets.empty()) {
      ASSERT_TRUE(open_secrets(*read, kPassphrase));
    }
    Archive files = read->backup.files;
    files.insert(files.end(), read->backup.secrets.begin(), read->backup.secrets.end());
    DiskChanges disk;
    ASSERT_TRUE(replace_files(other.places, files, disk));
    EXPECT_EQ(other.states(), device.states());
  }
}

TEST(BackupFile, SecretsAreEncryptedOrLeftOut) {
  for (const char* passphrase : {kPassphrase, ""}) {
    std::string all;
    for (const ArchivedFile& file : unpacked(bytes_of(example(), passphrase))) all += file.bytes;
    EXPECT_THAT(all, HasSubstr("rig = \"rig.toml\""));
    EXPECT_THAT(all, HasSubstr("state/users.json")) << "its name is listed";
    EXPECT_THAT(all, Not(HasSubstr("of-kim")));
    EXPECT_THAT(all, Not(HasSubstr(sha256("hash-of-kim")))) << "which would be guessed";
  }
  auto read = parse_backup(bytes_of(example()));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->backup.manifest.secrets, Secrets::Encrypted);
  EXPECT_TRUE(read->backup.secrets.empty());
  ASSERT_TRUE(open_secrets(*read, kPassphrase));
  EXPECT_EQ(read->backup.secrets, example().secrets);
  EXPECT_EQ(parse_backup(bytes_of(example(), ""))->backup.manifest.secrets, Secrets::LeftOut);
}

TEST(BackupFile, AWrongPassphraseOrAChangedManifestOpensNothing) {
  auto read = parse_backup(bytes_of(example()));
  ASSERT_TRUE(read);
  for (const char* wrong : {"", "correct horse batterz", "correct horse battery "}) {
    const auto opened = open_secrets(*read, wrong);
    ASSERT_FALSE(opened);
    EXPECT_THAT(opened.error().message, HasSubstr("the passphrase is wrong"));
  }
  Archive archive = unpacked(bytes_of(example()));
  archive.front().bytes.replace(archive.front().bytes.find("old-device"), 10, "new-device");
  auto changed = packed(archive);
  ASSERT_TRUE(changed) << changed.error().message;
  EXPECT_FALSE(open_secrets(*changed, kPassphrase));
  // Salt, header of the stream, cipher text, authentication.
  for (const std::size_t at :
       {std::size_t{0}, std::size_t{20}, std::size_t{100}, read->sealed.size() - 1}) {
    auto damaged = *read;
    damaged.sealed[at] = static_cast<char>(damaged.sealed[at] ^ 1);
    EXPECT_FALSE(open_secrets(damaged, kPassphrase)) << at;
  }
  read->sealed.resize(20);
  EXPECT_FALSE(open_secrets(*read, kPassphrase));
}

TEST(BackupFile, SecretsSealedWithAByteOrderMarkAreOpenedWithout) {
  const std::string marked = std::string("\xEF\xBB\xBF") + kPassphrase;
  auto read = parse_backup(bytes_of(example(), marked.c_str()));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_FALSE(open_secrets(*read, "correct horse batterz"));
  ASSERT_TRUE(open_secrets(*read, kPassphrase));
  EXPECT_EQ(read->backup.secrets, example().secrets);
}

TEST(BackupFile, FilesThatAreNotThoseOfTheManifestAreRefused) {
  const Archive right = unpacked(bytes_of(example(), ""));
  ASSERT_EQ(right.size(), 3U);
  Archive changed = right;
  changed[1].bytes[0] = 'R';
  EXPECT_THAT(refusal_of(packed(changed)), HasSubstr("not the file that was backed up"));
  changed = right;
  changed[1].mode = 0666;
  EXPECT_THAT(refusal_of(packed(changed)), HasSubstr("not the file that was backed up"));
  changed = right;
  changed.pop_back();
  EXPECT_THAT(refusal_of(packed(changed)), HasSubstr("missing or added"));
  changed = right;
  changed.push_back({"configuration/added.toml", ""});
  EXPECT_THAT(refusal_of(packed(changed)), HasSubstr("missing or added"));
  changed = unpacked(bytes_of(example()));
  changed.pop_back();
  EXPECT_THAT(refusal_of(packed(changed)), HasSubstr("secrets are missing"));
  EXPECT_THAT(refusal_of(packed({})), HasSubstr("no manifest"));
  EXPECT_THAT(refusal_of(packed({right.begin() + 1, right.end()})), HasSubstr("no manifest"));
}

TEST(BackupFile, FilesOutsideOfTheirPlacesAreRefused) {
  for (const char* name : {"state/commands", "state/users.json/x", "state/last-good.json",
                           "elsewhere/site.toml", "configuration", "absent"}) {
    Backup backup = example();
    backup.files = {{name, "x", 0644}};
    EXPECT_THAT(refusal_of(parse_backup(bytes_of(backup, ""))), HasSubstr("is not a file of a "))
        << name;
    backup = example();
    backup.secrets = {{name, "x", 0644}};
    auto read = parse_backup(bytes_of(backup));
    ASSERT_TRUE(read);
    EXPECT_FALSE(open_secrets(*read, kPassphrase)) << name;
  }
  Backup backup = example();
  backup.files = {{"configuration/../../etc/passwd", "x", 0644}};
  EXPECT_FALSE(backup_bytes(backup, ""));
}

TEST(BackupFile, ANewerFormatIsRefusedAndMoreMembersAreNot) {
  EXPECT_THAT(refusal_of(packed(with_manifest("\"orbwatch_backup\": 1", "\"orbwatch_backup\": 3"))),
              HasSubstr("of a newer orbwatch, of format 3; this one reads format 2"));
  EXPECT_TRUE(packed(with_manifest("\"version\"", "\"more\": [1], \"version\"")));
  EXPECT_TRUE(packed(with_manifest("\"0.1.2\"", "\"0.0.1\""))) << "an older product";
  for (const auto& [part, instead] : std::vector<std::pair<std::string, std::string>>{
           {"\"orbwatch_backup\": 1", "\"orbwatch_backup\": 0"},
           {"\"orbwatch_backup\": 1", "\"orbwatch_backup\": \"1\""},
           {"\"640\"", "\"6400\""},
           {"\"640\"", "\"9x1\""},
           {"\"left_out\"", "\"lost\""},
           {"\"files\": [", "\"files\": [7, "},
           {"{", "["}}) {
    EXPECT_THAT(refusal_of(packed(with_manifest(part, instead))), HasSubstr("is damaged"));
  }
}

TEST(BackupFile, MoreThanARestoreReadsIsRefused) {
  Backup large = example();
  large.secrets.clear();
  const std::string picture(std::size_t{16} << 20, 'x');
  for (int n = 0; n < 9; ++n) {
    large.files.push_back({"configuration/" + std::to_string(n) + ".toml", picture, 0640});
  }
  const auto refused = backup_bytes(large, "");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("more than 128 MiB"));
  EXPECT_THAT(refused.error().message, HasSubstr("configuration/0.toml"));
  large.files.resize(large.files.size() - 2);
  EXPECT_TRUE(parse_backup(bytes_of(large, "")));
}

TEST(BackupFile, DamagedBytesAreRefused) {
  const std::string bytes = bytes_of(example());
  for (std::size_t size = 0; size < bytes.size(); size += 11) {
    EXPECT_FALSE(parse_backup(bytes.substr(0, size))) << size;
  }
  EXPECT_FALSE(parse_backup("not a backup"));
  const auto bomb = compressed(std::string(kMostBytes + 1, '\0'));
  ASSERT_TRUE(bomb);
  EXPECT_THAT(refusal_of(parse_backup(*bomb)), HasSubstr("is larger than 128 MiB"));
}

TEST(Collect, SortsSecretsAndListsWhatIsLeftOut) {
  Device device;
  write_file(device.places.configuration / "site.toml", "a", 0644);
  write_file(device.places.configuration / "private.toml", "b", 0600);
  write_file(device.places.configuration / "inline.xml", "-----BEGIN PRIVATE KEY-----", 0644);
  write_file(device.places.configuration / "keys/key.pem", "d", 0640);
  write_file(device.places.configuration / "second/site.toml", "of a second machine", 0640);
  write_file(device.places.configuration / "recordings/1.toml", "e", 0640);
  write_file(device.places.state / "users.json", "f", 0600);
  write_file(device.places.state / "calibration.toml", "g", 0600);
  write_file(device.places.state / "first-code", "h", 0600);
  write_file(device.places.state / "commands", "i", 0600);
  std::filesystem::create_symlink("/etc/passwd", device.places.configuration / "passwd.toml");
  Site site = device.site();
  site.recordings = {device.places.configuration / "recordings"};
  site.named = {"/etc/ssl/https.key", device.places.configuration / "site.toml"};
  const auto backup = collect(site);
  ASSERT_TRUE(backup) << backup.error().message;
  const auto names = [](const Archive& files) {
    std::vector<std::string> all;
    for (const auto& file : files) all.push_back(file.name);
    return all;
  };
  EXPECT_THAT(names(backup->files),
              ElementsAre("configuration/site.toml", "state/calibration.toml"));
  EXPECT_THAT(names(backup->secrets),
              ElementsAre("configuration/inline.xml", "configuration/keys/key.pem",
                          "configuration/private.toml", "state/users.json"));
  EXPECT_THAT(backup->manifest.left_out,
              ElementsAre(HasSubstr("passwd.toml: is a link"), HasSubstr("/etc/ssl/https.key")));
}

}  // namespace
}  // namespace orbwatch::app::cli::backup
