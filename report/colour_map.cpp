#include "report/colour_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace clearloci::report {
namespace {

constexpr std::array<std::uint32_t, 256> viridis = {{
    // clang-format off
    0x440154, 0x440256, 0x450457, 0x450559, 0x46075a, 0x46085c, 0x460a5d, 0x460b5e, 0x470d60, 0x470e61, 0x471063, 0x471164,
    0x471365, 0x481467, 0x481668, 0x481769, 0x48186a, 0x481a6c, 0x481b6d, 0x481c6e, 0x481d6f, 0x481f70, 0x482071, 0x482173,
    0x482374, 0x482475, 0x482576, 0x482677, 0x482878, 0x482979, 0x472a7a, 0x472c7a, 0x472d7b, 0x472e7c, 0x472f7d, 0x46307e,
    0x46327e, 0x46337f, 0x463480, 0x453581, 0x453781, 0x453882, 0x443983, 0x443a83, 0x443b84, 0x433d84, 0x433e85, 0x423f85,
    0x424086, 0x424186, 0x414287, 0x414487, 0x404588, 0x404688, 0x3f4788, 0x3f4889, 0x3e4989, 0x3e4a89, 0x3e4c8a, 0x3d4d8a,
    0x3d4e8a, 0x3c4f8a, 0x3c508b, 0x3b518b, 0x3b528b, 0x3a538b, 0x3a548c, 0x39558c, 0x39568c, 0x38588c, 0x38598c, 0x375a8c,
    0x375b8d, 0x365c8d, 0x365d8d, 0x355e8d, 0x355f8d, 0x34608d, 0x34618d, 0x33628d, 0x33638d, 0x32648e, 0x32658e, 0x31668e,
    0x31678e, 0x31688e, 0x30698e, 0x306a8e, 0x2f6b8e, 0x2f6c8e, 0x2e6d8e, 0x2e6e8e, 0x2e6f8e, 0x2d708e, 0x2d718e, 0x2c718e,
    0x2c728e, 0x2c738e, 0x2b748e, 0x2b758e, 0x2a768e, 0x2a778e, 0x2a788e, 0x29798e, 0x297a8e, 0x297b8e, 0x287c8e, 0x287d8e,
    0x277e8e, 0x277f8e, 0x27808e, 0x26818e, 0x26828e, 0x26828e, 0x25838e, 0x25848e, 0x25858e, 0x24868e, 0x24878e, 0x23888e,
    0x23898e, 0x238a8d, 0x228b8d, 0x228c8d, 0x228d8d, 0x218e8d, 0x218f8d, 0x21908d, 0x21918c, 0x20928c, 0x20928c, 0x20938c,
    0x1f948c, 0x1f958b, 0x1f968b, 0x1f978b, 0x1f988b, 0x1f998a, 0x1f9a8a, 0x1e9b8a, 0x1e9c89, 0x1e9d89, 0x1f9e89, 0x1f9f88,
    0x1fa088, 0x1fa188, 0x1fa187, 0x1fa287, 0x20a386, 0x20a486, 0x21a585, 0x21a685, 0x22a785, 0x22a884, 0x23a983, 0x24aa83,
    0x25ab82, 0x25ac82, 0x26ad81, 0x27ad81, 0x28ae80, 0x29af7f, 0x2ab07f, 0x2cb17e, 0x2db27d, 0x2eb37c, 0x2fb47c, 0x31b57b,
    0x32b67a, 0x34b679, 0x35b779, 0x37b878, 0x38b977, 0x3aba76, 0x3bbb75, 0x3dbc74, 0x3fbc73, 0x40bd72, 0x42be71, 0x44bf70,
    0x46c06f, 0x48c16e, 0x4ac16d, 0x4cc26c, 0x4ec36b, 0x50c46a, 0x52c569, 0x54c568, 0x56c667, 0x58c765, 0x5ac864, 0x5cc863,
    0x5ec962, 0x60ca60, 0x63cb5f, 0x65cb5e, 0x67cc5c, 0x69cd5b, 0x6ccd5a, 0x6ece58, 0x70cf57, 0x73d056, 0x75d054, 0x77d153,
    0x7ad151, 0x7cd250, 0x7fd34e, 0x81d34d, 0x84d44b, 0x86d549, 0x89d548, 0x8bd646, 0x8ed645, 0x90d743, 0x93d741, 0x95d840,
    0x98d83e, 0x9bd93c, 0x9dd93b, 0xa0da39, 0xa2da37, 0xa5db36, 0xa8db34, 0xaadc32, 0xaddc30, 0xb0dd2f, 0xb2dd2d, 0xb5de2b,
    0xb8de29, 0xbade28, 0xbddf26, 0xc0df25, 0xc2df23, 0xc5e021, 0xc8e020, 0xcae11f, 0xcde11d, 0xd0e11c, 0xd2e21b, 0xd5e21a,
    0xd8e219, 0xdae319, 0xdde318, 0xdfe318, 0xe2e418, 0xe5e419, 0xe7e419, 0xeae51a, 0xece51b, 0xefe51c, 0xf1e51d, 0xf4e61e,
    0xf6e620, 0xf8e621, 0xfbe723, 0xfde725,
    // clang-format on
}};

Colour colour_of(std::uint32_t rgb) {
  const auto channel = [rgb](int shift) { return ((rgb >> shift) & 0xFF) / 255.0; };
  return {channel(16), channel(8), channel(0)};
}

using Triple = std::array<double, 3>;

double linear(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }
double gamma(double l) { return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055; }

/// sRGB's primaries, IEC 61966-2-1; white point D65.
constexpr std::array<Triple, 3> xyz_of_rgb = {
    {{0.4124564, 0.3575761, 0.1804375}, {0.2126729, 0.7151522, 0.0721750}, {0.0193339, 0.1191920, 0.9503041}}};
constexpr std::array<Triple, 3> rgb_of_xyz = {
    {{3.2404542, -1.5371385, -0.4985314}, {-0.9692660, 1.8760108, 0.0415560}, {0.0556434, -0.2040259, 1.0572252}}};
constexpr Triple white = {0.95047, 1.0, 1.08883};

Triple times(const std::array<Triple, 3>& matrix, const Triple& v) {
  Triple result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) result[i] += matrix[i][k] * v[k];
  return result;
}

/// Moreland's polar form of CIELAB: M = |(L, a, b)|, s = arccos(L / M), h = arctan(b / a).
Triple msh_of(const Colour& colour) {
  const Triple xyz = times(xyz_of_rgb, {linear(colour.red), linear(colour.green), linear(colour.blue)});
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; };
  const double x = f(xyz[0] / white[0]), y = f(xyz[1] / white[1]), z = f(xyz[2] / white[2]);
  const Triple lab = {116 * y - 16, 500 * (x - y), 200 * (y - z)};
  const double m = std::sqrt(lab[0] * lab[0] + lab[1] * lab[1] + lab[2] * lab[2]);
  return {m, std::acos(lab[0] / m), std::atan2(lab[2], lab[1])};
}

Colour colour_of_msh(const Triple& msh) {
  const Triple lab = {msh[0] * std::cos(msh[1]), msh[0] * std::sin(msh[1]) * std::cos(msh[2]),
                      msh[0] * std::sin(msh[1]) * std::sin(msh[2])};
  const auto f = [](double t) { return t > 0.206893 ? t * t * t : (t - 16.0 / 116) / 7.787; };
  const double y = (lab[0] + 16) / 116;
  const Triple rgb =
      times(rgb_of_xyz, {white[0] * f(y + lab[1] / 500), white[1] * f(y), white[2] * f(y - lab[2] / 200)});
  const auto channel = [](double l) { return std::clamp(gamma(std::max(0.0, l)), 0.0, 1.0); };
  return {channel(rgb[0]), channel(rgb[1]), channel(rgb[2])};
}

/// The hue of the white in the middle, turned so that the way to it looks straight (Moreland, section 5.3).
double turned_hue(const Triple& saturated, double middle) {
  const double turn =
      saturated[1] * std::sqrt(middle * middle - saturated[0] * saturated[0]) / (saturated[0] * std::sin(saturated[1]));
  return saturated[2] > -std::numbers::pi / 3 ? saturated[2] + turn : saturated[2] - turn;
}

}  // namespace

Colour sequential_colour(double t) {
  const double place = std::clamp(t, 0.0, 1.0) * (viridis.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const Colour a = colour_of(viridis[below]), b = colour_of(viridis[std::min(below + 1, viridis.size() - 1)]);
  const double part = place - static_cast<double>(below);
  return {a.red + part * (b.red - a.red), a.green + part * (b.green - a.green), a.blue + part * (b.blue - a.blue)};
}

Colour diverging_colour(double t) {
  constexpr double middle = 88;  // M of the lightest grey
  const double size = std::min(std::abs(t), 1.0);
  const Triple end =
      msh_of(t < 0 ? Colour{59 / 255.0, 76 / 255.0, 192 / 255.0} : Colour{180 / 255.0, 4 / 255.0, 38 / 255.0});
  const double hue = turned_hue(end, middle);
  return colour_of_msh({middle + size * (end[0] - middle), size * end[1], hue + size * (end[2] - hue)});
}

}  // namespace clearloci::report
