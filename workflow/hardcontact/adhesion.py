"""The interaction potential, the force sum, the force-separation curve, pull-off.

Eq. 2 of the paper gives the attraction of a pixel at the gap g as (W/rho) exp(-g/rho) A_pix. The
functions here return sums of exp(-g/rho); `pull_off_force` turns them into forces. The
exponential of the gap g = s - t - h factorizes, which is what makes the sum cheap.
"""

from concurrent.futures import ThreadPoolExecutor
from itertools import product

import numpy as np
from threadpoolctl import threadpool_limits

from hardcontact.contact import all_lowest_gaps
from hardcontact.sphere import paraboloid

__all__ = [
    "direct_sum",
    "force_separation",
    "plastic_total",
    "plastic_totals",
    "pull_off_force",
    "rough_sphere_sums",
    "rough_total",
    "smooth_sphere_sums",
]

#: An energy per area of 1 J/m² times a length of 1 nm is a force of 1e-9 N.
NEWTON_PER_JOULE_M2_NM = 1e-9

ROWS = 64  # rows a block: small enough for the cache, and the same for any number of threads


def pull_off_force(total, rho, pixel_size, work_of_adhesion):
    """Pull-off force (N), positive, from the sum of exp(-gap/rho) at closest approach: Eq. 3.

    total: any shape; rho, pixel_size: nm; work_of_adhesion: J/m². Raises ValueError if a sum left
    the range of numbers, which it does where the highest point outside the window stands many
    hundred rho above the contact.
    """
    if not np.isfinite(total).all():
        raise ValueError(
            "expected a range of adhesion that resolves the relief of the surface, "
            f"found rho = {np.min(rho):g} nm, too small for it"
        )
    return work_of_adhesion / rho * pixel_size**2 * NEWTON_PER_JOULE_M2_NM * total


def rough_total(outside, gaps, count, rho):
    """Sum of exp(-gap/rho) at the approach where `count` pixels touch a rough sphere.

    outside: what `rough_sphere_sums` returned for one contact, at an approach where all of `gaps`
    (k,) nm, ascending, touch; count: from 1 (rigid contact) to k. Further apart every gap is
    larger by the same, and those of the pixels that let go come in.
    """
    approach = gaps[count - 1]
    let_go = np.exp((approach - gaps[count:]) / rho).sum()
    return count + let_go + outside * np.exp((approach - gaps[-1]) / rho)


def plastic_total(everywhere, h_max, gaps, rho):
    """Sum of exp(-gap/rho) at plastic closest approach of a smooth sphere.

    everywhere: what `smooth_sphere_sums` returned for one contact; gaps: (count,) nm of the
    touching pixels, ascending. Each touching pixel counts as gap zero, not as its penetration;
    taking the difference off costs as many digits as exp(penetration/rho) has.
    """
    approach = gaps[-1]
    return np.exp((approach + h_max) / rho) * everywhere - np.expm1((approach - gaps) / rho).sum()


def plastic_totals(
    substrate, roughness, positions, pixel_size, radius, window, counts, rho, threads=1
):
    """Sums of exp(-gap/rho) of an array of plastic contacts: (load, contact, contact).

    counts: pixels that touch at each load; the other arguments as in `smooth_sphere_sums` and
    `rough_sphere_sums`; roughness: None for a smooth sphere.
    """
    geometry = pixel_size, radius, window
    contacts = all_lowest_gaps(substrate, positions, *geometry, max(counts), roughness)
    if roughness is None:
        everywhere, h_max = smooth_sphere_sums(substrate, positions, *geometry, rho, threads)

        def total(place, gaps, count):
            return plastic_total(everywhere[place], h_max, gaps[:count], rho)
    else:
        outside = rough_sphere_sums(substrate, roughness, positions, contacts, *geometry, [rho])[0]

        def total(place, gaps, count):
            return rough_total(outside[place], gaps, count, rho)

    totals = [
        total(place, gaps, count) for count in counts for place, (gaps, _) in contacts.items()
    ]
    return np.reshape(totals, (len(counts), len(positions), len(positions)))


def force_separation(pull_off, rho, separation):
    """Force (N, negative: attractive) at separations (nm) beyond closest approach.

    The deformed bodies move apart as they are, so all gaps grow alike and Eq. 3 decays with rho.
    """
    return -pull_off * np.exp(-np.asarray(separation) / rho)


def _folded(positions, pixels, pixel_size, radius, window, rho):
    """exp(-s/rho) along one axis, summed over periodic images in the window: (contact, n)."""
    offset = np.arange(window) - window // 2
    weight = np.exp(-paraboloid(offset, pixel_size, radius) / rho)
    return np.array(
        [np.bincount((position + offset) % pixels, weight, pixels) for position in positions]
    )


def smooth_sphere_sums(substrate, positions, pixel_size, radius, window, rho, threads=1):
    """Sum of exp((h - h_max - s)/rho) for an array of contacts of a smooth sphere, and h_max.

    substrate: h (n, n) in nm, periodic; positions: (contact,) pixels along either axis; radius,
    rho: nm; window: pixels. Returns (contact, contact) and h_max (nm): G exp((h-h_max)/rho) G^T,
    a product over both axes, because exp(-s/rho) is one. Exact to rounding, all terms positive.
    """
    h_max = float(substrate.max())
    fold = _folded(positions, substrate.shape[0], pixel_size, radius, window, rho)
    columns = np.ascontiguousarray(fold.T)

    def block(start):
        rows = slice(start, start + ROWS)
        return fold[:, rows] @ (_attraction(substrate[rows], h_max, rho) @ columns)

    with threadpool_limits(1, "blas"), ThreadPoolExecutor(threads) as pool:
        return sum(pool.map(block, range(0, substrate.shape[0], ROWS))), h_max


def _attraction(heights, highest, rho):
    """exp((heights - highest)/rho) in float64; heights in nm, of any precision."""
    attraction = np.subtract(heights, highest, dtype=float)
    attraction /= rho
    return np.exp(attraction, out=attraction)


def rough_sphere_sums(substrate, roughness, positions, contacts, pixel_size, radius, window, rhos):
    """Sum of exp(-(g + d)/rho) over pixels outside plastic contact, for an array of contacts.

    substrate: h (n, n), roughness: t (m, m), in nm, periodic, on the same pixels; positions:
    (contact,) pixels along either axis; contacts: dict (i, j) -> (gaps, offsets) of
    `contact.lowest_gaps`; d is minus the last of these gaps; rhos: (rho,) in nm.
    Returns (rho, contact, contact).

    exp(h/rho) and the kernel exp((t - s)/rho), folded over the periodic images in the window, are
    computed once a rho; each contact is then one dot product of positive terms. The touching
    pixels are left out of it beforehand: subtracting them would cost digits where rho is small.
    """
    pixels = substrate.shape[0]
    h_max, t_max = float(substrate.max()), float(roughness.max())
    images = {
        place: _image_gaps(
            substrate, roughness, positions[list(place)], offsets, pixel_size, radius, window
        )
        for place, (_, offsets) in contacts.items()
    }
    outside = np.empty((len(rhos), len(positions), len(positions)))
    for k, rho in enumerate(rhos):
        kernel = _kernel(pixels, roughness, t_max, pixel_size, radius, window, rho)
        attraction = _attraction(substrate, h_max, rho)
        for j, column in enumerate(positions):
            at_column = np.roll(kernel, column, axis=1)
            for i, row in enumerate(positions):
                gaps, offsets = contacts[i, j]
                y, x = (([row, column] + offsets) % pixels).T
                kept = attraction[y, x]
                attraction[y, x] = 0.0
                total = _shifted_dot(attraction, at_column, row)
                attraction[y, x] = kept
                outside[k, i, j] = (
                    np.exp((gaps[-1] + h_max + t_max) / rho) * total
                    + np.exp((gaps[-1] - images[i, j]) / rho).sum()
                )
    return outside


def _kernel(pixels, roughness, t_max, pixel_size, radius, window, rho):
    """exp((t - t_max - s)/rho) on (n, n) offsets from the apex, summed over its images."""
    attraction = _attraction(roughness, t_max, rho)
    period = roughness.shape[0]
    folded = _folded_by_shift(pixels, period, pixel_size, radius, window, rho)
    kernel, place = np.zeros((pixels, pixels)), np.arange(pixels)
    for start in range(0, pixels, ROWS):
        rows = place[start : start + ROWS]
        for (shift_y, weight_y), (shift_x, weight_x) in product(folded.items(), repeat=2):
            seen = attraction[np.ix_((rows + shift_y) % period, (place + shift_x) % period)]
            kernel[rows] += weight_y[rows, None] * weight_x * seen
    return kernel


def _folded_by_shift(pixels, period, pixel_size, radius, window, rho):
    """exp(-s/rho) along one axis summed over those images that see the roughness alike.

    Returns shift of the roughness -> (n,): a single shift where both periods are the same.
    """
    folded = {}
    reach = -(-window // (2 * pixels))
    for image in range(-reach, reach):
        offset = np.arange(pixels) + image * pixels
        inside = (offset >= -(window // 2)) & (offset < window // 2)
        weight = np.where(inside, np.exp(-paraboloid(offset, pixel_size, radius) / rho), 0.0)
        shift = image * pixels % period
        folded[shift] = folded.get(shift, 0.0) + weight
    return folded


def _shifted_dot(attraction, kernel, row):
    """Sum of attraction * kernel with the kernel's first row moved, periodically, to `row`."""
    rest = len(kernel) - row
    return (
        np.vecdot(attraction[:row], kernel[rest:]).sum()
        + np.vecdot(attraction[row:], kernel[:rest]).sum()
    )


def _image_gaps(substrate, roughness, position, touching, pixel_size, radius, window):
    """Gaps (k,) in nm of the periodic images, inside the window, of pixels that touch.

    Images that touch themselves are left out. touching: offsets (count, 2) from the apex.
    """
    pixels = substrate.shape[0]
    reach = -(-window // pixels)
    steps = np.stack(np.meshgrid(*[np.arange(-reach, reach + 1) * pixels] * 2), -1).reshape(-1, 2)
    places = np.unique((touching[:, None] + steps).reshape(-1, 2), axis=0)
    inside = ((places >= -(window // 2)) & (places < window // 2)).all(axis=1)
    code = (window * 4, 1)
    places = places[inside & ~np.isin(places @ code, touching @ code)]
    y, x = ((position + places) % pixels).T
    u, v = (places % roughness.shape[0]).T
    return paraboloid(places, pixel_size, radius).sum(axis=1) - roughness[u, v] - substrate[y, x]


def direct_sum(gaps, touching, rho):
    """Sum of exp(-(g + d)/rho) over every pixel but the `touching` lowest: Eq. 3 as it stands.

    gaps: (window, window) in nm at zero approach; -d is the last of the touching gaps. What the
    fast sums are checked and timed against.
    """
    ordered = np.partition(gaps.ravel(), touching - 1)
    return float(np.exp((ordered[touching - 1] - ordered[touching:]) / rho).sum())
