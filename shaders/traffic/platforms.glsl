// SPDX-License-Identifier: Apache-2.0
// Needs the block PlatformPoints and shaders/shared/outline.glsl.

bool isOnPlatform(Platform platform, vec2 place) {
    bool inside = false;
    vec2 before = platform_points[platform.first_point + platform.point_count - 1u];
    for (uint i = 0u; i < platform.point_count; ++i) {
        vec2 point = platform_points[platform.first_point + i];
        if (rayGoesOver(point, before, place)) inside = !inside;
        before = point;
    }
    return inside;
}
