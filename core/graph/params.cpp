// One kind of parameter after the other.
#include "core/graph/params.h"

#include "core/plugin/document.h"
#include "core/report/suggest.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace quell {

namespace fs = std::filesystem;

namespace {

// The nearest float of a number that is in range may lie outside by its rounding, and the other way round.
bool in_range(const quell_param& p, double v) {
  const auto inside = [&](double x) { return x >= p.min && x <= p.max; };
  return std::abs(v) <= double(std::numeric_limits<float>::max()) && (inside(v) || inside(double(float(v))));
}

ParamProblem assign_path(Instance& instance, int param, const Json& value, bool trusted, const Library& library) {
  fs::path file;
  if (value.text.starts_with("quell:")) {
    const auto found = library.installed(value.text);
    if (!found) return {fmt::format("{} leads out of the installed files", value.shown()), {}};
    file = *found;
  } else if (!trusted) {
    return {fmt::format("a graph names no files, as {} does", value.shown()),
            {"it may name installed ones, \"quell:…\"; the command line may name any: --set node.parameter=file"}};
  } else {
    file = value.text;
  }
  std::error_code error;
  if (!fs::exists(file, error))
    return {fmt::format("there is no file {}", value.shown()), {fmt::format("looked for {}", file.generic_string())}};
  instance.set_text(param, fs::absolute(file, error).lexically_normal().string());
  return {};
}

}  // namespace

ParamProblem assign(Instance& instance, int param, const Json& value, bool trusted, const Library& library) {
  const auto& p = instance.type().params()[std::size_t(param)];
  const auto refused = [&] {
    ParamProblem problem{fmt::format("{} is not {}", value.shown(), takes(p)),
                         {fmt::format("{}: {} Default {}.", p.name, p.doc, default_json(instance.type(), param))}};
    if (p.kind == QUELL_CHOICE && value.is(Json::Kind::text)) {
      const std::vector<std::string> choices(p.choices, p.choices + p.choice_count);
      const auto near = nearest(value.text, choices);
      if (!near.empty()) problem.notes.push_back(fmt::format("Did you mean '{}'?", near));
    }
    return problem;
  };
  switch (p.kind) {
    case QUELL_BOOL:
      if (!value.is(Json::Kind::boolean)) return refused();
      instance.set_bool(param, value.boolean);
      return {};
    case QUELL_INT: {
      const bool whole =
          value.is_number() && value.number == std::floor(value.number) && std::abs(value.number) < 2147483648.0;
      if (!whole || value.number < p.min || value.number > p.max) return refused();
      instance.set_int(param, int(value.number));
      return {};
    }
    case QUELL_FLOAT:
      if (!value.is_number() || !in_range(p, value.number)) return refused();
      instance.set_float(param, float(value.number));
      return {};
    case QUELL_CHOICE:
      for (int i = 0; value.is(Json::Kind::text) && i < p.choice_count; ++i)
        if (value.text == p.choices[i]) return instance.set_int(param, i), ParamProblem{};
      return refused();
    case QUELL_FLOATS: {
      if (!value.is(Json::Kind::list)) return refused();
      if (value.items.size() != std::size_t(p.count)) {
        auto problem = refused();
        problem.text = fmt::format("a list of {} is not {}", value.items.size(), takes(p));
        return problem;
      }
      std::vector<float> numbers;
      for (const auto& item : value.items) {
        if (!item.is_number() || !in_range(p, item.number)) {
          auto problem = refused();
          problem.text = fmt::format("a list with {} is not {}", item.shown(), takes(p));
          return problem;
        }
        numbers.push_back(float(item.number));
      }
      instance.set_floats(param, numbers);
      return {};
    }
    default:
      if (!value.is(Json::Kind::text) || value.text.find('\0') != std::string::npos) return refused();
      if (p.kind == QUELL_PATH && !value.text.empty()) return assign_path(instance, param, value, trusted, library);
      instance.set_text(param, value.text);
      return {};
  }
}

}  // namespace quell
