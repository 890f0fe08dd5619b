#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "synth/lips/lip_report.hpp"

namespace viaface {
namespace {

[[gnu::format(printf, 1, 2)]] std::string line(const char* format, ...) {
    std::array<char, 256> text{};
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text.data(), text.size(), format, arguments);
    va_end(arguments);
    return std::string(text.data()) + "\n";
}

std::string variance_cells(const LipFigures& figures, std::size_t mode) {
    if (mode >= figures.variance.size()) return "         -       -      -";
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%10.2f %6.2f%% %5.1f%%", figures.variance[mode],
                  100 * figures.variance[mode] / figures.total_variance, 100 * share_of(figures, mode + 1));
    return text.data();
}

std::string variance_table(const LipReport& report) {
    const LipFigures &t = report.trained, &r = report.recited;
    std::string text = line("%-22s %-26s %-26s %s", "", "trained", "recitations", "paper");
    text += line("%-22s %-26d %-26d %s", "frames", t.frames, r.frames, "150");
    text += line("%-22s %-26d %-26d %s", "modes above the noise", t.carried, r.carried, "10 taken");
    text += line("%-22s %-26zu %-26zu %d", "modes kept", t.variance.size(), r.variance.size(), kPaperModes);
    text += line("mode %17s %8s %6s %9s %8s %6s", "mm^2", "share", "so far", "mm^2", "share", "so far");
    for (std::size_t i = 0; i < std::max(t.variance.size(), r.variance.size()); ++i) {
        text += line("%4zu  %s  %s%s", i + 1, variance_cells(t, i).c_str(), variance_cells(r, i).c_str(),
                     i + 1 == kPaperModes ? "  99.2%" : "");
    }
    return text;
}

std::string error_row(const char* name, const ReconstructionError& e, double extent, double paper) {
    const double units = kPaperExtent / extent;
    return line("%-38s %11.2e %9.3f %11.2e %9.3f %11.2e", name, e.mesh * units * units, std::sqrt(e.mesh),
                e.points * units * units, std::sqrt(e.points), paper);
}

std::string table_one(const LipReport& report) {
    std::string text =
        "Whole shape from two of three coordinates (Table 1): mean square per degree of freedom,\n";
    text +=
        line("the mesh scaled to a largest extent of 2.83 (here %.1f mm), and rms in mm", report.extent_mm);
    text += line("%-38s %11s %9s %11s %9s %11s", "", "mesh", "mm", "16 points", "mm", "paper");
    const auto rows = [&](const std::string& what, const std::vector<ViewErrors>& by_modes) {
        const std::string name = what + ", " + std::to_string(by_modes.size()) + " modes, ";
        text += error_row((name + "x-y").c_str(), by_modes.back().frontal, report.extent_mm, kPaperFrontal);
        text += error_row((name + "y-z").c_str(), by_modes.back().profile, report.extent_mm, kPaperProfile);
    };
    rows("left out in turn", report.trained.by_modes);
    if (!report.tried.empty()) rows("test", report.tried);
    rows("recitations, left out", report.recited.by_modes);
    return text;
}

std::string slider(const LipReport& report) {
    std::string text = line("rms in mm over the mesh by number of modes: cross-validated x-y and y-z%s",
                            report.tried.empty() ? "" : "; test x-y and y-z");
    for (std::size_t i = 0; i < report.trained.by_modes.size(); ++i) {
        const ViewErrors& e = report.trained.by_modes[i];
        std::string row =
            line("%4zu %8.3f %8.3f", i + 1, std::sqrt(e.frontal.mesh), std::sqrt(e.profile.mesh));
        if (!report.tried.empty()) {
            row.pop_back();
            row += line("   %8.3f %8.3f", std::sqrt(report.tried[i].frontal.mesh),
                        std::sqrt(report.tried[i].profile.mesh));
        }
        text += row;
    }
    return text;
}

}  // namespace

std::string lip_report_text(const LipReport& report) {
    return line("Noise of a coordinate, stated: %.3g mm; modes below what it would give are dropped",
                report.noise_mm) +
           variance_table(report) + "\n" + table_one(report) + "\n" + slider(report) + "\n" +
           line("Least f'f beside least u'Ku: %.3f mm rms apart over the mesh, which moves %.3f mm rms",
                report.force_beside_energy_mm, report.moved_mm) +
           "The paper's data and these differ: its figures show the scale, not who is better.\n";
}

}  // namespace viaface
