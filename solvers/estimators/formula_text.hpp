#pragma once
// Internal to solvers: a formula of K as it is read, from the left to the right.

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>

#include "solvers/estimators/formula_compiler.hpp"

namespace ridgeloc::solvers {

inline std::string quoted(std::string_view text) {
  return '"' + std::string(text) + '"';
}

/// What is left of a formula, and errors that say where it is wrong.
class FormulaText {
 public:
  explicit FormulaText(std::string_view text) : text_(text) { skip_spaces(); }

  std::size_t position() const { return next_; }
  bool at_end() const { return next_ == text_.size(); }
  bool sees(char c) const { return !at_end() && text_[next_] == c; }
  bool takes(char c) {
    if (!sees(c)) return false;
    ++next_;
    skip_spaces();
    return true;
  }
  bool sees_name() const { return !at_end() && begins_name(text_[next_]); }
  bool sees_number() const { return !at_end() && (is_digit(text_[next_]) || text_[next_] == '.'); }
  std::string_view take_name() {
    const std::size_t begin = next_;
    while (!at_end() && (begins_name(text_[next_]) || is_digit(text_[next_]))) ++next_;
    const std::string_view name = text_.substr(begin, next_ - begin);
    skip_spaces();
    return name;
  }

  double take_number() {
    double number = 0.0;
    const char* const begin = text_.data() + next_;
    const auto [end, failure] = std::from_chars(begin, text_.data() + text_.size(), number);
    if (failure == std::errc::invalid_argument) throw error(next_, rest() + " is not a number");
    if (failure == std::errc::result_out_of_range)
      throw error(next_, quoted({begin, end}) + " is a number too large or too close to zero");
    next_ += static_cast<std::size_t>(end - begin);
    skip_spaces();
    return number;
  }

  [[nodiscard]] FormulaError error(std::size_t position, const std::string& what) const {
    return FormulaError(place(position) + ": " + what);
  }
  /// The text from here to the next space, as messages quote it: ends a formula that goes on where it may not.
  std::string rest() const {
    std::size_t end = next_ + 1;
    const bool in_word = begins_name(text_[next_]) || is_digit(text_[next_]) || text_[next_] == '.';
    while (in_word && end < text_.size() && (begins_name(text_[end]) || is_digit(text_[end]) || text_[end] == '.'))
      ++end;
    // A character of UTF-8 is not cut.
    while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0U) == 0x80U) ++end;
    return quoted(text_.substr(next_, end - next_));
  }
  [[noreturn]] void refuse_rest() const {
    if (sees(')')) throw error(next_, "this \")\" closes nothing");
    if (sees(',')) throw error(next_, "a comma separates values of a function; numbers have a point, 0.5");
    throw error(next_, "an operator is missing before " + rest() + "; allowed: + - * / ^");
  }
  [[noreturn]] void refuse_value() const {
    const char* const expected = "a number, a quantity, a function or \"(\" is missing";
    if (at_end()) throw error(next_, std::string("the formula ends where ") + expected);
    if (sees('*') && next_ > 0 && text_[next_ - 1] == '*') throw error(next_ - 1, "a power is written ^, not **");
    throw error(next_, std::string(expected) + " before " + rest());
  }

 private:
  static bool is_digit(char c) { return '0' <= c && c <= '9'; }
  static bool begins_name(char c) { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || c == '_'; }
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

  void skip_spaces() {
    while (!at_end() && is_space(text_[next_])) ++next_;
  }
  std::string place(std::size_t position) const {
    const std::string_view before = text_.substr(0, position);
    const std::size_t break_before = before.rfind('\n');
    const std::size_t column = break_before == std::string_view::npos ? position : position - break_before - 1;
    const std::string where = "column " + std::to_string(column + 1);
    if (text_.find('\n') == std::string_view::npos) return where;
    return "line " + std::to_string(std::ranges::count(before, '\n') + 1) + ", " + where;
  }

  std::string_view text_;
  std::size_t next_ = 0;
};

}  // namespace ridgeloc::solvers
