// Parses arithmetic by recursive descent into postfix steps.
#include "core/lab/expression.h"

#include "core/report/error.h"
#include "core/report/suggest.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <utility>

namespace quell {

class ExpressionParser {
 public:
  using Kind = Expression::Kind;

  explicit ExpressionParser(Expression& out) : out_(out), text_(out.text_) {}

  void parse() {
    sum();
    space();
    if (at_ != text_.size()) refuse(fmt::format("'{}' is not expected here", text_[at_]));
  }

 private:
  static constexpr int kDeepest = 200;

  void sum() {
    product();
    for (char sign = next("+-"); sign; sign = next("+-")) {
      product();
      push(sign == '+' ? Kind::add : Kind::subtract);
    }
  }
  void product() {
    factor();
    for (char sign = next("*/"); sign; sign = next("*/")) {
      factor();
      push(sign == '*' ? Kind::multiply : Kind::divide);
    }
  }
  void factor() {
    if (++depth_ > kDeepest) refuse(fmt::format("more than {} levels of parentheses and signs", kDeepest));
    if (next("-")) {
      factor();
      push(Kind::negate);
    } else if (next("(")) {
      sum();
      expect(')');
    } else {
      space();
      if (at_ == text_.size()) refuse("a number or a name is missing at the end");
      const auto c = static_cast<unsigned char>(text_[at_]);
      if (std::isdigit(c) || c == '.')
        number();
      else if (std::isalpha(c) || c == '_')
        name();
      else
        refuse(fmt::format("'{}' is not expected here", text_[at_]));
    }
    --depth_;
  }
  void number() {
    double value = 0;
    const auto* begin = text_.data() + at_;
    const auto [end, problem] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (problem != std::errc()) refuse("this is not a number");
    at_ += std::size_t(end - begin);
    out_.steps_.push_back({Kind::number, value});
  }
  void name() {
    const auto first = at_;
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_' || text_[at_] == '.'))
      ++at_;
    const std::string found = text_.substr(first, at_ - first);
    if (next("(")) return call(found, first);
    auto& names = out_.names_;
    const auto it = std::ranges::find(names, found);
    out_.steps_.push_back({Kind::name, 0, std::size_t(it - names.begin())});
    if (it == names.end()) names.push_back(found);
  }
  void call(const std::string& function, std::size_t first) {
    struct Function {
      const char* name;
      Kind kind;
      int arguments;
    };
    static constexpr std::array kFunctions = {Function{"abs", Kind::abs, 1}, Function{"sqrt", Kind::sqrt, 1},
                                              Function{"log2", Kind::log2, 1}, Function{"min", Kind::min, 2},
                                              Function{"max", Kind::max, 2}};
    const auto it = std::ranges::find_if(kFunctions, [&](const Function& f) { return f.name == function; });
    if (it == kFunctions.end()) {
      at_ = first;
      refuse(fmt::format("there is no function '{}'; {}", function,
                         possibilities("there are", function, names_of(kFunctions))));
    }
    sum();
    for (int i = 1; i < it->arguments; ++i) expect(','), sum();
    expect(')');
    push(it->kind);
  }

  void space() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  // The next character when it is one of `set`, else 0.
  char next(std::string_view set) {
    space();
    if (at_ == text_.size() || set.find(text_[at_]) == std::string_view::npos) return 0;
    return text_[at_++];
  }
  void expect(char c) {
    if (!next(std::string_view(&c, 1))) refuse(fmt::format("'{}' is missing here", c));
  }
  void push(Kind kind) { out_.steps_.push_back({kind}); }
  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(Exit::usage, fmt::format("'{}': {}\n  {}\n  {}^", text_, why, text_, std::string(at_, ' ')));
  }

  Expression& out_;
  const std::string& text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

Expression::Expression(std::string_view text) : text_(text) { ExpressionParser(*this).parse(); }

double Expression::operator()(const std::function<double(const std::string&)>& value) const {
  std::vector<double> stack;
  const auto pop = [&] {
    const double x = stack.back();
    stack.pop_back();
    return x;
  };
  const auto binary = [&](auto apply) {
    const double right = pop(), left = pop();
    stack.push_back(apply(left, right));
  };
  for (const auto& step : steps_) switch (step.kind) {
      case Kind::number:
        stack.push_back(step.number);
        break;
      case Kind::name:
        stack.push_back(value(names_[step.name]));
        break;
      case Kind::add:
        binary([](double a, double b) { return a + b; });
        break;
      case Kind::subtract:
        binary([](double a, double b) { return a - b; });
        break;
      case Kind::multiply:
        binary([](double a, double b) { return a * b; });
        break;
      case Kind::divide:
        binary([](double a, double b) { return a / b; });
        break;
      case Kind::min:
        binary([](double a, double b) { return std::min(a, b); });
        break;
      case Kind::max:
        binary([](double a, double b) { return std::max(a, b); });
        break;
      case Kind::negate:
        stack.push_back(-pop());
        break;
      case Kind::abs:
        stack.push_back(std::abs(pop()));
        break;
      case Kind::sqrt:
        stack.push_back(std::sqrt(pop()));
        break;
      case Kind::log2:
        stack.push_back(std::log2(pop()));
        break;
    }
  return stack.back();
}

}  // namespace quell
