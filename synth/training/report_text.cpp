#include <cstdio>
#include <utility>

#include "synth/training/report.hpp"

namespace viaface {
namespace {

template <class... Values>
std::string line(const char* format, Values... values) {
    char buffer[256];
    std::snprintf(buffer, sizeof buffer, format, values...);
    return std::string(buffer) + "\n";
}

std::string counts(const AtrReport& r) {
    return line("%-46s %14s %10s", "", "the report", "this") +
           line("%-46s %14s %10d", "scan samples (the report: nodes of a face)", "71100", r.scan_samples) +
           line("%-46s %14s %10d", "generic mesh, nodes", "576", r.nodes) +
           line("%-46s %14s %10d", "generic mesh, polygons", "844", r.polygons) +
           line("%-46s %14s %10d", "  of them quads", "not given", r.quads) +
           line("%-46s %14s %10d", "postures", "8", r.eight.postures) +
           line("%-46s %14s %10d", "components", "7", r.eight.components) +
           line("%-46s %14s %9.2f%%", "variance in the first five components", "over 99%",
                100 * r.eight.share.head(5).sum());
}

std::string variance(const std::string& name, const ModelFigures& m) {
    std::string text = name + ", variance per component and running sum, %\n";
    double sum = 0;
    for (int i = 0; i < m.components; ++i) {
        sum += m.share[i];
        text += line("  %2d %9.4f %9.4f", i + 1, 100 * m.share[i], 100 * sum);
    }
    return text + line("  markers' deviations: largest by smallest singular value %.0f", m.condition) +
           line("  training postures drawn from their own markers: worst node %.2g mm", m.trained_max) +
           (m.noise_mm > 0 ? line("  estimator with a ridge: coordinates' noise %.2f mm", m.noise_mm)
                           : line("  estimator by pseudo-inverse"));
}

std::string fit_table(const AtrReport& r) {
    std::string text = "fit, mm: scan samples to the fitted mesh; markers asked to fitted\n";
    text += line("  %-18s %6s %6s %6s  %-20s %7s %6s %6s", "", "mean", "p95", "max", "(max at x, y, z)",
                 "markers", "p95", "max");
    for (const FitFigures& f : r.fit) {
        text += line("  %-18s %6.2f %6.2f %6.2f  (%5.0f,%5.0f,%5.0f)  %7.3f %6.3f %6.3f", f.posture.c_str(),
                     f.surface.mean, f.surface.p95, f.surface.max, f.worst.x(), f.worst.y(), f.worst.z(),
                     f.markers.mean, f.markers.p95, f.markers.max);
    }
    return text;
}

std::string unseen_table(const std::string& title, const std::vector<UnseenFigures>& all) {
    std::string text = title + "\n";
    text += line("  %-18s %6s %6s   %6s %6s %6s   %6s %6s   %6s %6s", "", "span", "max", "drawn", "p95",
                 "max", "lips", "max", "points", "max");
    for (const UnseenFigures& u : all) {
        text += line("  %-18s %6.2f %6.2f   %6.2f %6.2f %6.2f   %6.2f %6.2f   %6.2f %6.2f", u.posture.c_str(),
                     u.span.mean, u.span.max, u.drawn.mean, u.drawn.p95, u.drawn.max, u.lips.mean, u.lips.max,
                     u.points.rms, u.points.max);
    }
    return text;
}

}  // namespace

std::string as_text(const AtrReport& r) {
    const std::string talker = "the talker's " + std::to_string(r.talker.postures) + " postures";
    return counts(r) + "\n" + fit_table(r) + "\n" + variance("eight postures", r.eight) + "\n" +
           variance(talker, r.talker) + "\n" +
           "Asked to drawn, mm. span: to the nearest shape the components can draw, mean and max over the "
           "nodes;\n"
           "drawn: to the shape estimated from the 18 markers; lips: the same on the outer lip contour;\n"
           "points: 18 markers and 16 lip points to the postures' own span, rms and max.\n\n" +
           unseen_table("eight postures, each left out of the model that draws it", r.eight.left_out) + "\n" +
           unseen_table("eight postures, on pressed /m/ and tucked /f/", r.beyond_eight) + "\n" +
           unseen_table("eight postures, on others (* not a mix of the talker's shapes)", r.eight.unseen) +
           "\n" + unseen_table(talker + ", each left out of the model that draws it", r.talker.left_out) +
           line("  with the pseudo-inverse instead of the ridge, the worst of these nodes is %.1f mm off",
                r.talker_unridged_max) +
           "\n" + unseen_table(talker + ", on others", r.talker.unseen);
}

}  // namespace viaface
