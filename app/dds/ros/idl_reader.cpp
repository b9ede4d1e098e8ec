#include "app/dds/ros/idl_reader.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

namespace orbwatch::app {
namespace {

constexpr std::string_view kScope = "::";
constexpr std::string_view kBlanks = " \t\r\n";

bool is_word_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

struct Token {
  std::string_view text;              ///< a word, a scope sign or one other letter; empty: the end
  std::vector<std::string> comments;  ///< lines that stand before it, on lines of their own
  std::string trailing;               ///< comment of the line on which the token before it ends
};

/// Cuts the text into tokens.
class Lexer {
 public:
  explicit Lexer(std::string_view text) : rest_(text) {}

  Token next() {
    Token token;
    bool same_line = true;
    for (;;) {
      skip_blanks(same_line);
      if (!rest_.starts_with("//") && !rest_.starts_with("/*")) break;
      const std::string_view comment = take_comment();
      if (same_line) {
        token.trailing = comment;
      } else {
        token.comments.emplace_back(comment);
      }
    }
    token.text = take(token_size());
    return token;
  }

  int line() const { return line_; }

 private:
  void skip_blanks(bool& same_line) {
    const std::size_t size = std::min(rest_.find_first_not_of(kBlanks), rest_.size());
    if (take(size).find('\n') != std::string_view::npos) same_line = false;
  }

  std::string_view take_comment() {
    const bool block = rest_.starts_with("/*");
    const std::size_t end = rest_.find(block ? "*/" : "\n");
    const std::string_view whole = take(std::min(end, rest_.size()));
    if (block) take(std::min<std::size_t>(2, rest_.size()));
    return trimmed(whole.substr(2));
  }

  std::size_t token_size() const {
    if (rest_.empty()) return 0;
    if (rest_.starts_with(kScope)) return kScope.size();
    const auto end = std::find_if_not(rest_.begin(), rest_.end(), is_word_letter);
    return std::max<std::size_t>(1, static_cast<std::size_t>(end - rest_.begin()));
  }

  std::string_view take(std::size_t size) {
    const std::string_view taken = rest_.substr(0, size);
    line_ += static_cast<int>(std::count(taken.begin(), taken.end(), '\n'));
    rest_.remove_prefix(size);
    return taken;
  }

  std::string_view rest_;
  int line_ = 1;
};

/// What cannot be read; leaves this file as an Error.
struct Unreadable {
  std::string reason;
};

class Parser {
 public:
  explicit Parser(std::string_view text) : lexer_(text) { advance(); }

  MessageTypes parse() {
    while (!now_.text.empty()) {
      if (now_.text == "@") {
        annotation();
      } else if (accept("module")) {
        modules_.emplace_back(word());
        expect("{");
      } else if (accept("}")) {
        if (modules_.empty()) throw refusal("a module");
        modules_.pop_back();
        expect(";");
      } else {
        structure();
      }
    }
    if (!modules_.empty()) throw refusal("\"}\"");
    return std::move(types_);
  }

 private:
  void advance() { now_ = lexer_.next(); }

  Unreadable refusal(std::string_view wanted) const {
    const std::string found = now_.text.empty() ? "the end" : "\"" + std::string(now_.text) + "\"";
    return {"IDL, line " + std::to_string(lexer_.line()) + ": " + found + " where " +
            std::string(wanted) + " should stand"};
  }

  bool accept(std::string_view text) {
    if (now_.text != text) return false;
    advance();
    return true;
  }
  void expect(std::string_view text) {
    if (!accept(text)) throw refusal("\"" + std::string(text) + "\"");
  }
  std::string word() {
    if (now_.text.empty() || !is_word_letter(now_.text.front())) throw refusal("a name");
    std::string text(now_.text);
    advance();
    return text;
  }
  std::uint32_t number() {
    std::uint32_t value = 0;
    const char* end = now_.text.data() + now_.text.size();
    const auto [stop, error] = std::from_chars(now_.text.data(), end, value);
    if (error != std::errc{} || stop != end || value == 0) throw refusal("a number above 0");
    advance();
    return value;
  }

  /// How a type is extended and what is a topic shows on the wire or not at all.
  void annotation() {
    const std::vector<std::string> comments = now_.comments;
    expect("@");
    word();
    // What stands before the annotation is about what it annotates.
    now_.comments.insert(now_.comments.begin(), comments.begin(), comments.end());
  }

  void structure() {
    MessageType type;
    type.comment = now_.comments;
    expect("struct");
    type.name = ros_type_name(scoped(word()));
    expect("{");
    while (now_.text != "}") type.fields.push_back(member());
    expect("}");
    expect(";");
    types_.emplace(type.name, type);
  }

  MessageField member() {
    MessageField field;
    for (const std::string& line : now_.comments) add_comment(field, line);
    if (accept("sequence")) {
      expect("<");
      value_type(field);
      expect(">");
      field.count = FieldCount::Sequence;
    } else {
      value_type(field);
    }
    field.name = word();
    if (field.count == FieldCount::One && accept("[")) {
      field.count = FieldCount::Array;
      field.capacity = number();
      expect("]");
    }
    expect(";");
    add_comment(field, now_.trailing);
    return field;
  }

  static void add_comment(MessageField& field, std::string_view line) {
    if (!field.comment.empty() && !line.empty()) field.comment += " ";
    field.comment += line;
  }

  void value_type(MessageField& field) {
    const std::string name = type_name();
    const auto basic = std::ranges::find(kBasicTypes, name, &BasicType::idl);
    if (basic == kBasicTypes.end()) {
      field.nested = nested_type(name);
      return;
    }
    field.kind = basic->kind;
    if (field.kind == FieldKind::String && accept("<")) {
      field.kind = FieldKind::BoundedString;
      field.string_capacity = number();
      expect(">");
    }
  }

  std::string type_name() {
    std::string name = word();
    while (accept(kScope)) name += std::string(kScope) + word();
    return name;
  }

  std::string nested_type(const std::string& name) const {
    for (const std::string& candidate : {ros_type_name(scoped(name)), ros_type_name(name)}) {
      if (types_.contains(candidate)) return candidate;
    }
    throw Unreadable{"IDL, line " + std::to_string(lexer_.line()) + ": type \"" + name +
                     "\" is not known; a struct has to stand before it is used"};
  }

  /// The name with those of the modules around it.
  std::string scoped(const std::string& name) const {
    std::string whole;
    for (const std::string& module : modules_) whole += module + std::string(kScope);
    return whole + name;
  }

  Lexer lexer_;
  Token now_;
  std::vector<std::string> modules_;
  MessageTypes types_;
};

}  // namespace

Result<MessageTypes> read_idl(std::string_view text) {
  try {
    return Parser(text).parse();
  } catch (const Unreadable& unreadable) {
    return fail(unreadable.reason);
  }
}

std::string ros_type_name(std::string_view idl_name) {
  std::string name;
  while (!idl_name.empty()) {
    const std::size_t end = std::min(idl_name.find(kScope), idl_name.size());
    std::string_view part = idl_name.substr(0, end);
    idl_name.remove_prefix(std::min(end + kScope.size(), idl_name.size()));
    if (part == "dds_") continue;
    if (idl_name.empty() && part.ends_with('_')) part.remove_suffix(1);
    if (!name.empty()) name += "/";
    name += part;
  }
  return name;
}

}  // namespace orbwatch::app
