// SPDX-License-Identifier: Apache-2.0
#include "app/model/plain_text.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>

namespace orbwatch::app {
namespace {

constexpr std::size_t kPlenty = 1000;

TEST(PlainText, LeavesTextOfEveryScriptAsItIs) {
  for (const char* text :
       {"", "cell 3 <b>&\"'", "Zelle für Größe", "電腦", "𝄞 😀", "\xf4\x8f\xbf\xbf"}) {
    EXPECT_EQ(plain_text(text, kPlenty), text);
  }
}

TEST(PlainText, HasAQuestionMarkForEachByteThatIsNoUtf8) {
  for (const auto& [text, plain] : std::initializer_list<std::pair<const char*, const char*>>{
           {"a\xff"
            "b",
            "a?b"},
           {"\x80", "?"},
           {"\xc0\xaf", "??"},            // '/' in two bytes
           {"\xe0\x80\xaf", "???"},       // '/' in three
           {"\xf0\x80\x80\xaf", "????"},  // '/' in four
           {"\xed\xa0\x80", "???"},       // half of a surrogate pair
           {"\xf4\x90\x80\x80", "????"},  // beyond the last character
           {"\xe2\x82", "??"},            // cut off
           {"\xe2\x82z", "??z"}}) {
    EXPECT_EQ(plain_text(text, kPlenty), plain);
  }
}

TEST(PlainText, HasNothingThatControlsATerminalOrTheDirectionOfWriting) {
  EXPECT_EQ(plain_text(std::string_view("a\x1b[2J\n\t\0\x7f", 8), kPlenty),
            "a?[2J??"
            "?");
  for (const char* control :
       {"\xc2\x85", "\xe2\x80\xa8", "\xe2\x80\xae", "\xe2\x81\xa6", "\xe2\x80\x8f", "\xd8\x9c"}) {
    EXPECT_EQ(plain_text(control, kPlenty), "?");
  }
}

TEST(PlainText, IsCutBetweenCharacters) {
  EXPECT_EQ(plain_text("für", 2), "f");
  EXPECT_EQ(plain_text("für", 3), "fü");
  EXPECT_EQ(plain_text("\xff\xff\xff", 2), "??");
  EXPECT_EQ(plain_text("x", 0), "");
}

TEST(PlainText, OfAnyBytesIsPlainItself) {
  std::mt19937 random(1);
  for (int n = 0; n < 20000; ++n) {
    std::string bytes(random() % 12, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    const std::string plain = plain_text(bytes, 8);
    ASSERT_LE(plain.size(), 8U);
    ASSERT_EQ(plain_text(plain, kPlenty), plain);
  }
}

}  // namespace
}  // namespace orbwatch::app
