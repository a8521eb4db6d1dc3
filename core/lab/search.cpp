// A search by NLopt over the unit cube that stands for the ranges.
#include "core/lab/search.h"

#include "core/lab/range.h"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>

namespace quell {

namespace {

struct Search {
  std::span<const SearchRange> ranges;
  const std::function<double(std::span<const double>)>& function;
  nlopt_opt method;
  SearchResult result;
  std::exception_ptr failure;

  double parameter(std::size_t i, double unit) const {
    const auto& r = ranges[i];
    const double x = in_range(r.from, r.to, r.log, unit);
    return std::clamp(r.integer ? std::round(x) : x, r.from, r.to);
  }
  double unit(std::size_t i) const {
    const auto& r = ranges[i];
    const double x =
        r.log ? std::log(r.start / r.from) / std::log(r.to / r.from) : (r.start - r.from) / (r.to - r.from);
    return std::clamp(x, 0.0, 1.0);
  }

  double evaluate(const double* units) {
    // What is worse than any number: NLopt wants finite ones.
    constexpr double kWorst = 1e300;
    std::vector<double> x(ranges.size());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = parameter(i, units[i]);
    try {
      const double found = function(x);
      const double value = std::isfinite(found) ? found : kWorst;
      if (result.evaluations++ == 0 || value < result.value) result.value = value, result.best = x;
      return value;
    } catch (...) {
      failure = std::current_exception();
      nlopt_force_stop(method);
      return kWorst;
    }
  }
};

double evaluate(unsigned, const double* units, double*, void* search) {
  return static_cast<Search*>(search)->evaluate(units);
}

}  // namespace

SearchResult search(std::span<const SearchRange> ranges, int most, double tolerance,
                    const std::function<double(std::span<const double>)>& function) {
  const auto n = unsigned(ranges.size());
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> method(nlopt_create(NLOPT_LN_NELDERMEAD, n), nlopt_destroy);
  Search state{ranges, function, method.get(), {}, {}};
  std::vector<double> x(n);
  for (unsigned i = 0; i < n; ++i) x[i] = state.unit(i);
  nlopt_set_lower_bounds1(method.get(), 0);
  nlopt_set_upper_bounds1(method.get(), 1);
  nlopt_set_initial_step1(method.get(), 0.25);
  nlopt_set_xtol_abs1(method.get(), tolerance);
  nlopt_set_maxeval(method.get(), most);
  nlopt_set_min_objective(method.get(), evaluate, &state);
  double value = 0;
  const auto end = nlopt_optimize(method.get(), x.data(), &value);
  if (state.failure) std::rethrow_exception(state.failure);
  state.result.converged = end == NLOPT_XTOL_REACHED;
  return state.result;
}

}  // namespace quell
