// The tables are built by the SDK from structs whose work is to do nothing.
#include "tests/support/graph_nodes.h"
#include "tests/support/add_type.h"
#include "tests/support/paths.h"

#include <quell/node.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace quell::test {

namespace {

struct Idle {
  void run(const Tile&) const {}
};
struct IdleWeight {
  void weigh(const quell_input*, const quell_run&, float*) const {}
};

struct Demodulate : Idle {
  In<Radiance> image;
  In<Albedo> albedo;
  Out<Radiance> out;
  void describe(Describe& d) {
    d.summary("Divides radiance by albedo.");
    d.in(image, "image", "Radiance.");
    d.in(albedo, "albedo", "Albedo.");
    d.out(out, "image", "Radiance over albedo.").passes(image);
  }
};
struct Modulate : Idle {
  In<Radiance> image, emission;
  In<Albedo> albedo;
  Out<Radiance> out;
  void describe(Describe& d) {
    d.summary("Multiplies by albedo.");
    d.in(image, "image", "Radiance over albedo.");
    d.in(albedo, "albedo", "Albedo.");
    d.in(emission, "emission", "Radiance to add.").optional();
    d.out(out, "image", "Radiance.").passes(image);
  }
};
struct DepthSlope : Idle {
  In<Depth> depth;
  Out<Slope> slope;
  void describe(Describe& d) {
    d.summary("Screen-space derivatives of depth.");
    d.in(depth, "depth", "Depth.").halo(1);
    d.out(slope, "slope", "Slope of depth.");
  }
};
struct Disocclusion : Idle {
  In<Motion> motion;
  In<Slope> slope;
  In<Depth> depth, depth_before;
  In<Normal> normal, normal_before;
  In<Id> id, id_before;
  Out<Taps> taps;
  void describe(Describe& d) {
    d.summary("Which pixels of the previous frame show the same surface.");
    d.in(motion, "motion", "Pixels, previous - current.");
    d.in(slope, "slope", "Slope of depth.").optional();
    d.in(depth, "depth", "Depth now.").optional();
    d.in(depth_before, "depth_before", "Depth one frame earlier.").optional().anywhere();
    d.in(normal, "normal", "Normal now.").optional();
    d.in(normal_before, "normal_before", "Normal one frame earlier.").optional().anywhere();
    d.in(id, "id", "Object now.").optional();
    d.in(id_before, "id_before", "Object one frame earlier.").optional().anywhere();
    d.out(taps, "taps", "Validated weights.");
  }
};
struct HistoryLength : Idle {
  In<Count> before;
  In<Motion> motion;
  In<Taps> taps;
  Out<Count> count;
  int max = 32;
  void describe(Describe& d) {
    d.summary("Counts accumulated frames.");
    d.in(before, "before", "This count, one frame earlier.").anywhere();
    d.in(motion, "motion", "Pixels, previous - current.");
    d.in(taps, "taps", "Validated weights.");
    d.out(count, "count", "Frames accumulated.");
    d.param(max, "max", "Where counting ends.").range(1, 65536);
  }
};
struct Reproject : Idle {
  In<Any> image;
  In<Motion> motion;
  In<Taps> taps;
  Out<Any> out;
  void describe(Describe& d) {
    d.summary("Warps an image of the previous frame.");
    d.in(image, "image", "An image of the previous frame.").anywhere();
    d.in(motion, "motion", "Pixels, previous - current.");
    d.in(taps, "taps", "Validated weights.");
    d.out(out, "image", "The history of each pixel.");
  }
};
struct TemporalBlend : Idle {
  In<Any> current, history;
  In<Count> count;
  Out<Any> out;
  float alpha = 0.2f;
  bool warm_up = true;
  void describe(Describe& d) {
    d.summary("Blends history and the current frame.");
    d.in(current, "current", "This frame.");
    d.in(history, "history", "Reprojected history.");
    d.in(count, "count", "Frames accumulated.");
    d.out(out, "image", "The average so far.").passes(current);
    d.param(alpha, "alpha", "Weight of this frame once warmed up.").range(0, 1);
    d.param(warm_up, "warm_up", "A plain mean until 1/alpha frames are there.");
  }
};
struct LuminanceMoments : Idle {
  In<Radiance> image;
  Out<Moments> moments;
  void describe(Describe& d) {
    d.summary("First and second moment of luminance.");
    d.in(image, "image", "Radiance.");
    d.out(moments, "moments", "l and l squared.");
  }
};
struct NormalWeight : IdleWeight {
  enum class Mode : std::int32_t { power, angle };
  In<Normal> normal;
  Out<Weight> weight;
  Mode mode = Mode::power;
  float power = 128, sigma = 0.1f;
  void describe(Describe& d) {
    d.summary("Unlikeness of normals.");
    d.in(normal, "normal", "World-space unit normals.");
    d.out(weight, "weight", "A power of the cosine.");
    d.param(mode, "mode", "Falloff.", {"power", "angle"});
    d.param(power, "power", "Of the cosine; higher is stricter.").range(1, 4096);
    d.param(sigma, "sigma", "Standard deviation of the angle, radians.").range(1e-3f, 10);
  }
};
struct PlaneWeight : IdleWeight {
  In<Normal> normal;
  In<Position> position;
  Out<Weight> weight;
  float sigma = 0.1f;
  void describe(Describe& d) {
    d.summary("Distance from the plane of the centre.");
    d.in(normal, "normal", "World-space unit normals.");
    d.in(position, "position", "World-space positions.");
    d.out(weight, "weight", "A gaussian of the distance.");
    d.param(sigma, "sigma", "Standard deviation, scene units.").range(1e-4f, 1e6f);
  }
};
struct DepthWeight : IdleWeight {
  In<Depth> depth;
  In<Slope> slope;
  Out<Weight> weight;
  float sigma = 1;
  void describe(Describe& d) {
    d.summary("Unlikeness of depths.");
    d.in(depth, "depth", "Depth.");
    d.in(slope, "slope", "Slope of depth.").optional();
    d.out(weight, "weight", "An exponential of the difference.");
    d.param(sigma, "sigma", "Slopes that cost a factor of e.").range(1e-4f, 1e6f);
  }
};
struct LuminanceWeight : IdleWeight {
  In<Radiance> image;
  In<Variance> variance;
  Out<Weight> weight;
  float sigma = 4;
  void describe(Describe& d) {
    d.summary("Unlikeness of luminances.");
    d.in(image, "image", "Radiance.");
    d.in(variance, "variance", "Variance of its luminance.").optional();
    d.out(weight, "weight", "An exponential of the difference.");
    d.param(sigma, "sigma", "Standard deviations that cost a factor of e.").range(1e-4f, 1e6f);
  }
};
struct VarianceEstimate : Idle {
  In<Radiance> image;
  In<Moments> moments;
  In<Count> count;
  InList<Weight> weights;
  Out<Radiance> steadied;
  Out<Variance> variance;
  int radius = 3, min_count = 4;
  void describe(Describe& d) {
    d.summary("Variance from moments, spatial where history is short.");
    d.in(image, "image", "Accumulated radiance.").halo(radius);
    d.in(moments, "moments", "Accumulated moments.").halo(radius);
    d.in(count, "count", "Frames accumulated.");
    d.in(weights, "weights", "Edge-stopping functions.").halo(radius);
    d.out(steadied, "image", "The image, steadied where history is short.").passes(image);
    d.out(variance, "variance", "Variance of luminance.");
    d.param(radius, "radius", "Half-width of the neighbourhood, pixels.").range(1, 8);
    d.param(min_count, "min_count", "Frames from which the pixel alone is trusted.").range(1, 64);
  }
};
struct Gaussian : Idle {
  enum class Kernel : std::int32_t { gaussian, binomial, box };
  In<Any> image;
  Out<Any> out;
  Kernel kernel = Kernel::gaussian;
  float sigma = 1;
  int radius = 3;
  void describe(Describe& d) {
    d.summary("A separable blur.");
    d.in(image, "image", "What is blurred.").halo(radius);
    d.out(out, "image", "The mean over the kernel.").passes(image);
    d.param(kernel, "kernel", "Shape of the kernel.", {"gaussian", "binomial", "box"});
    d.param(sigma, "sigma", "Standard deviation, pixels.").range(0.1f, 64);
    d.param(radius, "radius", "Half-width, pixels.").range(1, 64);
  }
};
struct Atrous : Idle {
  In<Any> image;
  In<Variance> variance;
  InList<Weight> weights;
  Out<Any> filtered;
  Out<Variance> filtered_variance;
  int step = 1;
  void describe(Describe& d) {
    d.summary("One level of the wavelet filter with holes.");
    d.in(image, "image", "What is filtered.").halo(2 * step).step(step);
    d.in(variance, "variance", "Variance, filtered alongside.").optional().halo(2 * step).step(step);
    d.in(weights, "weights", "Edge-stopping functions.").halo(2 * step).step(step);
    d.out(filtered, "image", "The weighted mean.").passes(image);
    d.out(filtered_variance, "variance", "Variance of the mean.").passes(variance).with(variance);
    d.param(step, "step", "Distance between taps, pixels.").range(1, 64);
  }
};
struct OutlierClamp : Idle {
  In<Radiance> image;
  Out<Radiance> out;
  float k = 2;
  void describe(Describe& d) {
    d.summary("Clamps outliers.");
    d.in(image, "image", "Noisy radiance.").halo(3);
    d.out(out, "image", "Radiance without outliers.").passes(image);
    d.param(k, "k", "Half-width of the accepted range, standard deviations.").range(0, 1e6);
  }
};
struct Mean : Idle {
  InList<Any> images;
  Out<Any> out;
  void describe(Describe& d) {
    d.summary("Takes the mean of images.");
    d.in(images, "images", "Any number of images.");
    d.out(out, "image", "Their mean.");
  }
};
struct Pack : Idle {
  InList<Any> images;
  Out<Features> out;
  void describe(Describe& d) {
    d.summary("Joins images.");
    d.in(images, "images", "Any number of images.");
    d.out(out, "image", "All their channels.");
  }
};
// Every kind of parameter.
struct Grade : Idle {
  In<Radiance> image;
  Out<Display> out;
  Vec<3> lift{{0, 0, 0}};
  Text look;
  Path table;
  int level = 1;
  void describe(Describe& d) {
    d.summary("Grades for display.");
    d.in(image, "image", "Radiance.");
    d.out(out, "image", "Display colours.");
    d.param(lift, "lift", "Added to each channel.").range(-1, 1);
    d.param(look, "look", "Name of the look.");
    d.param(table, "table", "A file with a look-up table.");
    d.param(level, "level", "How strong.").range(0, 10);
  }
};

}  // namespace

Registry& graph_registry() {
  static Registry registry({});
  static const bool added =
      add_type<Demodulate>(registry, "demodulate") && add_type<Modulate>(registry, "modulate") &&
      add_type<DepthSlope>(registry, "depth_slope") && add_type<Disocclusion>(registry, "disocclusion") &&
      add_type<HistoryLength>(registry, "history_length") && add_type<Reproject>(registry, "reproject") &&
      add_type<TemporalBlend>(registry, "temporal_blend") &&
      add_type<LuminanceMoments>(registry, "luminance_moments") && add_type<NormalWeight>(registry, "normal_weight") &&
      add_type<PlaneWeight>(registry, "plane_weight") && add_type<DepthWeight>(registry, "depth_weight") &&
      add_type<LuminanceWeight>(registry, "luminance_weight") &&
      add_type<VarianceEstimate>(registry, "variance_estimate") && add_type<Gaussian>(registry, "gaussian") &&
      add_type<Atrous>(registry, "atrous") && add_type<OutlierClamp>(registry, "outlier_clamp") &&
      add_type<Mean>(registry, "mean") && add_type<Pack>(registry, "pack") && add_type<Grade>(registry, "grade");
  EXPECT_TRUE(added);
  return registry;
}

LoadedGraph load(GraphRequest request) {
  LoadedGraph out;
  Diagnostics diagnostics;
  out.graph = load_graph(request, graph_registry(), diagnostics, &out.info);
  out.messages = diagnostics.format();
  return out;
}

LoadedGraph load_text(std::string text, std::vector<Edit> edits) {
  GraphRequest request;
  request.graph = "t.json";
  request.graphs = std::string(QUELL_TEST_SOURCE) + "/tests/bad/graphs";
  request.edits = std::move(edits);
  request.text = std::move(text);
  return load(std::move(request));
}

std::string shown(const Graph& g) {
  const auto source = [&](const Source& s) {
    if (s.node == Source::kInput) return g.inputs[std::size_t(s.port)].name;
    const auto& n = g.nodes[std::size_t(s.node)];
    return n.name + "." + n.type().outputs()[std::size_t(s.port)].name;
  };
  const auto wire = [&](const Wire& w) {
    std::string out = source(w.from);
    if (w.delay) out += fmt::format("@-{}", w.delay);
    if (w.start.node != Source::kNone) out += "|" + source(w.start);
    return out;
  };
  std::string out;
  for (const auto& n : g.nodes) {
    out += n.name + " <-";
    for (std::size_t p = 0; p < n.in.size(); ++p)
      for (const auto& w : n.in[p]) out += fmt::format(" {}:{}", n.type().inputs()[p].name, wire(w));
    out += "\n";
  }
  for (const auto& o : g.outputs) out += fmt::format("{}{} = {}\n", o.tap ? "tap " : "", o.name, wire(o.wire));
  return out;
}

std::string svgf_file() { return std::string(QUELL_TEST_SOURCE) + "/tests/core/graphs/svgf.json"; }

LoadedGraph load_svgf(std::vector<Edit> edits) {
  GraphRequest request;
  request.graph = svgf_file();
  request.edits = std::move(edits);
  return load(std::move(request));
}

std::string graph_with(std::string_view nodes, std::string_view outputs) {
  return fmt::format(
      R"({{"quell": 1, "inputs": {{"color": "radiance", "albedo": "albedo", "normal": "normal", "depth": "depth",
          "id": "id?", "motion": "motion"}}, "nodes": {{{}}}, "outputs": {{{}}}}})",
      nodes, outputs);
}

const GraphNode& node_called(const Graph& g, std::string_view name) {
  for (const auto& n : g.nodes)
    if (n.name == name) return n;
  throw std::runtime_error("no node " + std::string(name));
}

std::string line_of(const LoadedGraph& l, const std::string& name) {
  if (!l.graph) return l.messages;
  const std::string all = "\n" + shown(*l.graph);
  const auto at = all.find("\n" + name + " ");
  return at == all.npos ? "" : all.substr(at + 1, all.find('\n', at + 1) - at - 1);
}

}  // namespace quell::test
