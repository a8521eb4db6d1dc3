// The falloffs of <quell/falloff.h> in double precision.
#include "tests/support/falloffs.h"

#include <cmath>
#include <map>
#include <numbers>

namespace quell::test {

namespace {

const std::map<std::string, double (*)(double)>& table() {
  static const std::map<std::string, double (*)(double)> functions = {
      {"gaussian", [](double x) { return std::exp(-x * x / 2); }},
      {"exponential", [](double x) { return std::exp(-x); }},
      {"cosine", [](double x) { return x < 1 ? std::cos(std::numbers::pi / 2 * x) : 0; }},
      {"tent", [](double x) { return x < 1 ? 1 - x : 0; }},
      {"smoothstep", [](double x) { return x < 1 ? 1 - x * x * (3 - 2 * x) : 0; }},
      {"rational", [](double x) { return 1 / (1 + 3 * x + 9 * x * x); }},
      {"step", [](double x) { return x < 1 ? 1.0 : 0.0; }}};
  return functions;
}

}  // namespace

const std::vector<std::string>& falloff_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const auto& [name, function] : table()) list.push_back(name);
    return list;
  }();
  return names;
}

double falloff(const std::string& name, double x) { return table().at(name)(x); }

}  // namespace quell::test
