# SPDX-License-Identifier: GPL-3.0-or-later
"""Signals of benchmarks: periods by zero crossings, extremes of each period, zero-phase filter. Standard library only."""

import bisect
import math


def resample(times, values, rate):
    """The signal on a uniform grid of rate samples a second, by linear interpolation: (times, values)."""
    if len(times) < 2:
        raise ValueError("a signal needs two samples or more")
    n = int(math.floor((times[-1] - times[0]) * rate * (1 + 1e-12))) + 1
    grid = [times[0] + i / rate for i in range(n)]
    result, k = [], 0
    for t in grid:
        while k + 2 < len(times) and times[k + 1] < t:
            k += 1
        width = times[k + 1] - times[k]
        s = (t - times[k]) / width if width > 0 else 0.0
        result.append(values[k] + s * (values[k + 1] - values[k]))
    return grid, result


def _biquad(values, b, a):
    """One pass, started in the steady state of the first value."""
    z2 = (b[2] - a[2]) * values[0]
    z1 = (b[1] - a[1]) * values[0] + z2
    result = []
    for x in values:
        y = b[0] * x + z1
        z1 = b[1] * x - a[1] * y + z2
        z2 = b[2] * x - a[2] * y
        result.append(y)
    return result


def butterworth(values, rate, cutoff):
    """Second-order Butterworth low-pass run forwards and backwards (no phase shift), ends continued by reflection in
    the end point."""
    if not 0 < cutoff < rate / 2:
        raise ValueError("the cut-off must lie between 0 and half the sample rate")
    k = math.tan(math.pi * cutoff / rate)
    norm = 1 / (1 + math.sqrt(2) * k + k * k)
    b = (k * k * norm, 2 * k * k * norm, k * k * norm)
    a = (1.0, 2 * (k * k - 1) * norm, (1 - math.sqrt(2) * k + k * k) * norm)
    pad = min(len(values) - 1, int(3 * rate / cutoff))
    head = [2 * values[0] - v for v in values[pad:0:-1]]
    tail = [2 * values[-1] - v for v in values[-2:-pad - 2:-1]]
    signal = _biquad(head + list(values) + tail, b, a)
    signal = _biquad(signal[::-1], b, a)[::-1]
    return signal[pad:pad + len(values)]


def crossings(times, values, level=0.0, falling=False):
    """Times at which the signal passes the level upwards (with falling: in either direction)."""
    result = []
    for i in range(1, len(values)):
        before, after = values[i - 1] - level, values[i] - level
        if before < 0 <= after or (falling and before >= 0 > after):
            result.append(times[i - 1] + (times[i] - times[i - 1]) * before / (before - after))
    return result


def frequency(marks):
    """Frequency from the times of the starts of periods, or nan."""
    return (len(marks) - 1) / (marks[-1] - marks[0]) if len(marks) > 1 else math.nan


def extremes(times, values, marks):
    """(mean of the smallest, mean of the largest) value of each period between marks, or (nan, nan)."""
    low, high = [], []
    for start, end in zip(marks, marks[1:]):
        part = values[bisect.bisect_left(times, start):bisect.bisect_right(times, end)]
        if part:
            low.append(min(part))
            high.append(max(part))
    if not low:
        return math.nan, math.nan
    return sum(low) / len(low), sum(high) / len(high)


def window(times, start, end, *signals):
    """The samples with start <= t <= end: [times, signal, ...]."""
    first, last = bisect.bisect_left(times, start - 1e-9), bisect.bisect_right(times, end + 1e-9)
    return [list(times[first:last])] + [list(signal[first:last]) for signal in signals]
