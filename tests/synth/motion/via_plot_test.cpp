#include "synth/motion/via_plot.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.hpp"

namespace viaface {
namespace {

ViaPlot plot_of(std::vector<double> via_mm) {
    ViaPlot plot;
    plot.title = "<within> \"1\" & less";
    PlottedCoordinate coordinate;
    coordinate.coordinate = 3 * kChin + 1;
    coordinate.via.points.resize(std::ssize(via_mm), 1);
    for (std::size_t i = 0; i < via_mm.size(); ++i) {
        coordinate.via.time_s.push_back(0.25 * static_cast<double>(i));
        coordinate.via.points(static_cast<Eigen::Index>(i), 0) = via_mm[i];
    }
    for (int i = 0; i <= 100; ++i) {
        plot.time_s.push_back(0.01 * i);
        coordinate.measured.push_back(-40 + i % 7);
    }
    plot.coordinates.push_back(coordinate);
    plot.sound.assign(16000, 1000);
    return plot;
}

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++found;
    return found;
}

// Elements close in the order in which they opened, and nothing stands loose.
void expect_well_formed(const std::string& svg) {
    std::vector<std::string> open;
    std::size_t at = svg.find("?>") + 2;
    while ((at = svg.find('<', at)) != svg.npos) {
        const std::size_t end = svg.find('>', at);
        ASSERT_NE(end, svg.npos);
        const std::string tag = svg.substr(at + 1, end - at - 1);
        EXPECT_EQ(tag.find('<'), tag.npos);
        EXPECT_EQ(std::count(tag.begin(), tag.end(), '"') % 2, 0) << tag;
        if (tag.front() == '/') {
            ASSERT_FALSE(open.empty());
            EXPECT_EQ(open.back(), tag.substr(1));
            open.pop_back();
        } else if (tag.back() != '/') {
            open.push_back(tag.substr(0, tag.find(' ')));
        }
        at = end + 1;
    }
    EXPECT_TRUE(open.empty());
}

TEST(ViaPlot, IsWellFormedAndFinite) {
    const std::string svg = format_via_plot(plot_of({-40, -38, -41, -37, -39}));
    expect_well_formed(svg);
    EXPECT_EQ(svg.find("nan"), svg.npos);
    EXPECT_EQ(svg.find("inf"), svg.npos);
    EXPECT_NE(svg.find("&lt;within&gt; &quot;1&quot; &amp; less"), svg.npos);
}

TEST(ViaPlot, ShowsEachViaPointOfItsSpanOnce) {
    ViaPlot plot = plot_of({-40, -38, -41, -37, -39});
    EXPECT_EQ(count(format_via_plot(plot), "<circle"), 5u + 1u) << "and one in the legend";
    plot.from_s = 0.2;
    plot.to_s = 0.6;
    EXPECT_EQ(count(format_via_plot(plot), "<circle"), 2u + 1u);
}

TEST(ViaPlot, APointThatDoesNotMoveIsDrawnToo) {
    ViaPlot plot = plot_of({-40, -40, -40, -40, -40});
    std::fill(plot.coordinates[0].measured.begin(), plot.coordinates[0].measured.end(), -40);
    plot.sound.clear();
    expect_well_formed(format_via_plot(plot));
}

TEST(ViaPlot, PointsAreNamedWithTheirAxes) {
    const std::vector<int> measured{kLipTop, kLipBottom, kChin};
    EXPECT_EQ(plotted_coordinates("lip_bottom_x,chin", measured),
              (std::vector<int>{3 * kLipBottom, 3 * kChin + 1}));
    EXPECT_EQ(plotted_coordinates("", measured),
              (std::vector<int>{3 * kLipTop + 1, 3 * kLipBottom + 1, 3 * kChin + 1}));
    for (const char* wrong : {"lip_bottom_w", "nose", "chin,,chin", "chin,"})
        EXPECT_THROW(plotted_coordinates(wrong, measured), InputError) << wrong;
}

}  // namespace
}  // namespace viaface
