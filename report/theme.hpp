// The colours of every picture, and of the pages that a browser draws: one source, light as on paper and dark.
// Private to report/.
#pragma once

#include <array>

namespace clearloci::report {

struct Colour {
  double red = 0, green = 0, blue = 0;
};

struct Theme {
  Colour paper, ink, faded_ink, frame, grid;
  Colour workspace;
  Colour outline, link, load;  ///< of the mechanism
  Colour verified, failed;     ///< of a task
  Colour singularity, boundary;
  Colour circle;                 ///< the largest in a zone
  std::array<Colour, 6> curves;  ///< of reaction loci, in turn
  std::array<Colour, 7> zones;   ///< in turn
  double zone_strength = 0.5;    ///< of their fill
};

// Curves: Okabe and Ito's palette (Color Universal Design, 2008) without black, which direct singularities have, and
// without yellow, which is too light for a line on white. Ordered so that neighbours differ in lightness too.
// Zones: the light scheme of P. Tol, Colour Schemes (SRON/EPS/TN/09-002, issue 3.2), distinct to the colour-blind.
inline constexpr Theme light_theme{.paper = {1, 1, 1},
                                   .ink = {0.13, 0.13, 0.13},
                                   .faded_ink = {0.40, 0.40, 0.40},
                                   .frame = {0.45, 0.45, 0.45},
                                   .grid = {0.86, 0.86, 0.86},
                                   .workspace = {0.925, 0.941, 0.957},
                                   .outline = {0.20, 0.24, 0.30},
                                   .link = {0.62, 0.68, 0.76},
                                   .load = {0.55, 0.05, 0.10},
                                   .verified = {0.00, 0.40, 0.22},
                                   .failed = {0.75, 0.10, 0.10},
                                   .singularity = {0, 0, 0},
                                   .boundary = {0.35, 0.35, 0.35},
                                   .circle = {0.30, 0.30, 0.34},
                                   .curves = {{{0.000, 0.447, 0.698},    // blue
                                               {0.835, 0.369, 0.000},    // vermilion
                                               {0.000, 0.620, 0.451},    // bluish green
                                               {0.800, 0.475, 0.655},    // reddish purple
                                               {0.902, 0.624, 0.000},    // orange
                                               {0.337, 0.706, 0.914}}},  // sky blue
                                   .zones = {{{0.467, 0.667, 0.867},
                                              {0.933, 0.867, 0.533},
                                              {0.267, 0.733, 0.600},
                                              {1.000, 0.667, 0.733},
                                              {0.600, 0.867, 1.000},
                                              {0.933, 0.533, 0.400},
                                              {0.733, 0.800, 0.200}}}};

// The hues of the light theme, lighter where a line has to stand out from a dark page; zones are fainter.
inline constexpr Theme dark_theme{.paper = {0.086, 0.102, 0.125},
                                  .ink = {0.91, 0.92, 0.94},
                                  .faded_ink = {0.66, 0.68, 0.72},
                                  .frame = {0.50, 0.53, 0.58},
                                  .grid = {0.20, 0.22, 0.26},
                                  .workspace = {0.135, 0.160, 0.195},
                                  .outline = {0.78, 0.82, 0.88},
                                  .link = {0.36, 0.42, 0.50},
                                  .load = {1.00, 0.52, 0.52},
                                  .verified = {0.35, 0.85, 0.58},
                                  .failed = {1.00, 0.50, 0.45},
                                  .singularity = {1, 1, 1},
                                  .boundary = {0.62, 0.64, 0.68},
                                  .circle = {0.70, 0.72, 0.78},
                                  .curves = {{{0.340, 0.650, 0.960},
                                              {0.960, 0.490, 0.180},
                                              {0.100, 0.760, 0.580},
                                              {0.900, 0.600, 0.780},
                                              {0.970, 0.740, 0.220},
                                              {0.550, 0.830, 0.980}}},
                                  .zones = light_theme.zones,
                                  .zone_strength = 0.26};

/// Of the zones on white, from 0 on: seven, then these darker, then lighter, so that no two of 21 look alike.
inline Colour zone_colour(std::size_t number) {
  constexpr double darker = 0.68, lighter = 0.5;
  const Colour& zone = light_theme.zones[number % light_theme.zones.size()];
  const auto mixed = [](const Colour& colour, double part, double with) {
    const auto one = [&](double value) { return part * value + (1 - part) * with; };
    return Colour{one(colour.red), one(colour.green), one(colour.blue)};
  };
  switch (number / light_theme.zones.size() % 3) {
    case 1:
      return mixed(zone, darker, 0);
    case 2:
      return mixed(zone, lighter, 1);
    default:
      return zone;
  }
}

}  // namespace clearloci::report
