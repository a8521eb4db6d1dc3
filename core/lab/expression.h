// Arithmetic over named numbers: "flicker - 0.5 * psnr_unbiased.min".
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace quell {

// Numbers, names (letters, digits, _ and .), + - * /, parentheses, and abs sqrt log2 min max.
class Expression {
 public:
  // Throws Error(Exit::usage) that shows where the text stops making sense.
  explicit Expression(std::string_view text);

  const std::string& text() const { return text_; }
  // As they stand in it, each once.
  const std::vector<std::string>& names() const { return names_; }
  double operator()(const std::function<double(const std::string& name)>& value) const;

 private:
  friend class ExpressionParser;
  enum class Kind { number, name, add, subtract, multiply, divide, negate, abs, sqrt, log2, min, max };
  struct Step {
    Kind kind;
    double number = 0;
    std::size_t name = 0;
  };
  std::string text_;
  std::vector<std::string> names_;
  std::vector<Step> steps_;  // postfix
};

}  // namespace quell
