// Walks a camera around the point that it looks at.
(() => {
    const minus = (a, b) => a.map((x, i) => x - b[i]);
    const steepest = 1.45; // radians; straight from above, "up" would have no meaning

    /** The camera turned by angles, and at `far` times its distance. */
    Page.walked = ({ from, at, fov }, { across = 0, upward = 0, far = 1 }) => {
        const way = minus(from, at), distance = Math.hypot(...way) * far;
        const angle = Math.atan2(way[0], way[2]) + across;
        const rise = Math.max(-steepest, Math.min(steepest, Math.asin(way[1] / Math.hypot(...way)) + upward));
        const offset = [Math.cos(rise) * Math.sin(angle), Math.sin(rise), Math.cos(rise) * Math.cos(angle)];
        return { at, fov, from: offset.map((x, i) => Number((at[i] + distance * x).toFixed(3))) };
    };
})();
