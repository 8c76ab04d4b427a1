#include "rasterizer.hpp"

namespace foam::snapshot::shaders {

// Light from the upper left behind the eye, a weak one from the right, and more from above than from below. `up` is the
// picture's upward direction; normals face the eye.
const char* const prelude = R"(#version 330 core
vec3 shade(vec3 base, vec3 n, float gloss) {
    const vec3 key = vec3(-0.380, 0.527, 0.760);
    const vec3 fill = vec3(0.700, -0.050, 0.712);
    const vec3 halfway = vec3(-0.203, 0.281, 0.938);   // between key and the eye
    float light = 0.47 + 0.10 * n.y + 0.47 * max(dot(n, key), 0.0) + 0.17 * max(dot(n, fill), 0.0);
    return min(base * light + gloss * pow(max(dot(n, halfway), 0.0), 48.0), 1.0);
}
)";

const char* const facet_vertex = R"(
layout(location = 0) in vec3 position;   // samples from the view's middle
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 tint;
layout(location = 3) in float edges;
uniform vec2 middle;                     // of the view, samples from the lower left corner
uniform vec2 size;                       // of the picture, samples
uniform float depth;                     // all geometry is within ± depth
uniform float factor;                    // samples a pixel
flat out vec3 facet_normal;
flat out vec4 facet_tint;
out vec3 barycentric;
void main() {
    facet_normal = normal;
    facet_tint = vec4(tint, edges);
    int corner = gl_VertexID % 3;
    barycentric = vec3(corner == 0, corner == 1, corner == 2);
    gl_Position = vec4((middle + factor * position.xy) / size * 2.0 - 1.0, -position.z / depth, 1.0);
}
)";

// Edges fade where facets are only a few pixels high, so that fine meshes do not turn black (barycentric wireframe
// after Baerentzen et al. 2006, "Single-pass wireframe rendering").
const char* const facet_fragment = R"(
flat in vec3 facet_normal;
flat in vec4 facet_tint;
in vec3 barycentric;
uniform float factor;
layout(location = 0) out vec4 colour;
void main() {
    vec3 n = facet_normal.z < 0.0 ? -facet_normal : facet_normal;
    vec3 surface = shade(facet_tint.rgb, n, 0.05);
    vec3 slope = sqrt(dFdx(barycentric) * dFdx(barycentric) + dFdy(barycentric) * dFdy(barycentric));
    slope = max(slope, vec3(1e-9)) * factor;
    vec3 pixels = barycentric / slope;
    float line = 1.0 - smoothstep(0.25, 1.0, min(pixels.x, min(pixels.y, pixels.z)));
    float height = 1.0 / max(slope.x, max(slope.y, slope.z));
    line *= facet_tint.a * smoothstep(2.0, 12.0, height);
    colour = vec4(mix(surface, vec3(0.16, 0.20, 0.28), 0.62 * line), 1.0);
}
)";

const char* const glass_fragment = R"(
flat in vec3 facet_normal;
layout(location = 0) out vec4 colour;
void main() {
    vec3 n = facet_normal.z < 0.0 ? -facet_normal : facet_normal;
    colour = vec4(0.5 * n + 0.5, 1.0);
}
)";

const char* const ball_vertex = R"(
layout(location = 0) in vec3 center;
layout(location = 1) in float radius;
layout(location = 2) in vec3 tint;
layout(location = 3) in float identity;
uniform vec2 middle;
uniform vec2 size;
uniform float depth;
uniform float factor;
flat out vec4 ball_tint;
flat out float ball_depth;
flat out float ball_radius;
out vec2 across;                         // position on the disc, in radii
void main() {
    float reach = 1.0 + 1.0 / max(factor * radius, 1.0);   // a sample more than the disc
    across = reach * vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID >> 1) * 2 - 1);
    ball_tint = vec4(tint, identity / 255.0);
    ball_depth = center.z / depth;
    ball_radius = radius / depth;
    gl_Position = vec4((middle + factor * (center.xy + radius * across)) / size * 2.0 - 1.0, 0.0, 1.0);
}
)";

// In a parallel projection the ray meets the sphere at z = sqrt(1 - x² - y²).
const char* const ball_fragment = R"(
flat in vec4 ball_tint;
flat in float ball_depth;
flat in float ball_radius;
in vec2 across;
layout(location = 0) out vec4 colour;
void main() {
    float rest = 1.0 - dot(across, across);
    if (rest < 0.0) {
        discard;
    }
    vec3 n = vec3(across, sqrt(rest));
    colour = vec4(shade(ball_tint.rgb, n, 0.16), ball_tint.a);
    gl_FragDepth = 0.5 - 0.5 * (ball_depth + ball_radius * n.z);
}
)";

const char* const compose_vertex = R"(
void main() {
    gl_Position = vec4((gl_VertexID & 1) * 4 - 1, (gl_VertexID >> 1) * 4 - 1, 0.0, 1.0);
}
)";

// The translucent mesh is a layer over the spheres, with its nearest surface only, so that the order of drawing is not
// visible. Behind the surface of a sphere it fades with depth, so that parts outside of the spheres are prominent.
const char* const compose_fragment = R"(
uniform sampler2D solid_colour;          // alpha: 0 background, 255 mesh, others the identity of a sphere
uniform sampler2D solid_depth;
uniform sampler2D glass_normal;          // alpha: 0 nothing there
uniform sampler2D glass_depth;
uniform int samples;                     // a pixel and side
uniform float opacity;
uniform float fading;                    // depth below a sphere's surface at which the mesh has faded by 1/e
layout(location = 0) out vec4 colour;
const ivec2 around[4] = ivec2[4](ivec2(1, 0), ivec2(0, 1), ivec2(-1, 0), ivec2(0, -1));

float outline(ivec2 p, ivec2 last, int reach, vec4 here) {
    float darkest = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec4 there = texelFetch(solid_colour, clamp(p + reach * around[i], ivec2(0), last), 0);
        if (there.a != here.a) {
            darkest = max(darkest, min(here.a, there.a) == 0.0 ? 0.45 : 0.30);
        }
    }
    return darkest;
}

float crease(ivec2 p, ivec2 last, int reach, vec3 n) {
    float sharpest = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec4 there = texelFetch(glass_normal, clamp(p + reach * around[i], ivec2(0), last), 0);
        float line = there.a == 0.0 ? 1.0 : 1.0 - smoothstep(0.70, 0.92, dot(n, 2.0 * there.xyz - 1.0));
        sharpest = max(sharpest, line);
    }
    return sharpest;
}

vec3 composed(ivec2 p, ivec2 last) {
    int reach = max(1, samples / 2);
    vec4 solid = texelFetch(solid_colour, p, 0);
    vec3 result = solid.a == 0.0 ? vec3(1.0) : solid.rgb;
    result *= 1.0 - outline(p, last, reach, solid);
    vec4 glass = texelFetch(glass_normal, p, 0);
    if (glass.a == 0.0) {
        return result;
    }
    float below = texelFetch(glass_depth, p, 0).r - texelFetch(solid_depth, p, 0).r;
    if (below > 0.0 && solid.a == 1.0) {
        return result;                   // hidden by an opaque mesh
    }
    vec3 n = normalize(2.0 * glass.xyz - 1.0);
    float strength = below > 0.0 ? 0.7 * exp(-below / fading) : 1.0;
    float line = crease(p, last, reach, n);
    result = mix(result, shade(vec3(0.92, 0.94, 0.97), n, 0.0), opacity * strength);
    return mix(result, vec3(0.10, 0.13, 0.20), 0.55 * line * min(1.0, 2.0 * opacity) * strength);
}

void main() {
    ivec2 corner = ivec2(gl_FragCoord.xy) * samples;
    ivec2 last = textureSize(solid_colour, 0) - 1;
    vec3 sum = vec3(0.0);
    for (int y = 0; y < samples; ++y) {
        for (int x = 0; x < samples; ++x) {
            sum += composed(corner + ivec2(x, y), last);
        }
    }
    colour = vec4(sum / float(samples * samples), 1.0);
}
)";

} // namespace foam::snapshot::shaders
