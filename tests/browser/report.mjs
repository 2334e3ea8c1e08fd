// Facts about the report in headless Chromium, driven by Playwright: clicks, drags, zooming and keys.
// node report.mjs FOLDER: FOLDER holds the reports that test_tutor writes. SCREENSHOTS=OUT also takes screenshots.
import assert from "node:assert/strict";
import path from "node:path";
import { after, test } from "node:test";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const folder = path.resolve(process.argv[2]);
const desktop = [1440, 900], phone = [375, 812], tablet = [768, 1024];
const pages = ["wrong", "good", "unbuilt", "evil", "single", "unknown"];
const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", chromiumSandbox: process.getuid() !== 0,
});
after(() => browser.close());

const contexts = {}; // key: whether it emulates a phone
let context, page;   // of the open report
const requests = [], complaints = new Set();

async function openPage(mobile) {
    context = await browser.newContext({ isMobile: mobile, hasTouch: mobile, deviceScaleFactor: mobile ? 2 : 1 });
    await context.grantPermissions(["clipboard-read", "clipboard-write"]);
    const page = await context.newPage();
    page.on("request", request => requests.push(request.url()));
    page.on("console", message => complaints.add(message.text()));
    page.on("pageerror", error => complaints.add(error.message));
    return { context, page, devtools: await context.newCDPSession(page) };
}

/** Opens a report in a window of this size, with media features such as colorScheme: "dark". */
async function open(name, [width, height] = desktop, media = {}) {
    const mobile = width === phone[0];
    ({ context, page } = contexts[mobile] ??= await openPage(mobile));
    await page.mouse.move(0, 0);
    await page.setViewportSize({ width, height });
    await page.emulateMedia({ colorScheme: "light", reducedMotion: "no-preference", ...media });
    await page.goto(pathToFileURL(path.join(folder, name + ".html")).href);
    await page.evaluate(() => Promise.all([...document.images].map(image => image.decode())));
}

// --- user input -------------------------------------------------------------------------------------------------------

const move = ([x, y]) => page.mouse.move(x, y);
const click = selector => page.click(selector);
const drag = async (begin, end) => {
    await move(begin);
    await page.mouse.down();
    await page.mouse.move(...end, { steps: 5 });
    await page.mouse.up();
};
const press = async (...keys) => {
    for (const key of keys) await page.keyboard.press(key);
};
const wheel = async (point, delta) => {
    await page.waitForTimeout(400); // longer than the pause after which a wheel event belongs to the picture
    await move(point);
    await page.mouse.wheel(0, delta);
    await page.waitForTimeout(100);
};
/** Sends a touch event of this kind (touchStart, touchMove, touchEnd); fingers: the window points of all that are down. */
const touch = async (kind, ...fingers) => {
    const touchPoints = fingers.map(([x, y], id) => ({ x, y, id }));
    await contexts[true].devtools.send("Input.dispatchTouchEvent", { type: kind, touchPoints });
};

// --- what is visible --------------------------------------------------------------------------------------------------

const text = selector => page.locator(selector).first().innerText();
const visible = selector => page.locator(selector).first().isVisible();
const style = (selector, name) => page.$eval(selector, (e, name) => getComputedStyle(e)[name], name);
const all = (selector, of) => page.$$eval(selector, of);
const see = expression => page.evaluate(expression);
const box = selector => page.$eval(selector, e => e.getBoundingClientRect().toJSON());
const near = (got, want, tolerance, what) =>
    assert.ok(Math.abs(got - want) <= tolerance, `${what}: expected ${want} within ${tolerance}, got ${got}`);

/** Scrolls to the pictures; returns a function that maps fractions of the first pane to a point of the window. */
async function showPane() {
    await see("document.getElementById('viewer').scrollIntoView({block: 'start', behavior: 'instant'})");
    const pane = await box(".pane");
    return (x, y) => [pane.left + x * pane.width, pane.top + y * pane.height];
}
/** Returns the window point of a pixel's centre, if the whole picture fits into its pane. */
async function pointOf(x, y) {
    const [width, height] = await see("[pictures.width, pictures.height]");
    return (await showPane())((x + 0.5) / width, (y + 0.5) / height);
}
/** Returns the pictures that are shown, pane by pane. */
const layers = () => all(".pane", panes => panes.filter(p => p.checkVisibility()).map(
    p => [...p.querySelectorAll(".layer")].filter(l => l.checkVisibility()).map(l => l.dataset.picture)));
/** Returns the number of CSS pixels per pixel of the picture. */
const scale = () => page.$eval(".layer:not([hidden]) img", i => i.getBoundingClientRect().width / i.width);
/** Returns the fraction of the pane, from its left, that shows the learner's picture. */
async function wipe() {
    const clip = await style(".layer[data-picture=mine]", "clipPath");
    const match = /^inset\(0px (?:calc\(100% - ([\d.]+)%\)|([\d.]+)(?:%|px)) 0px 0px\)$/.exec(clip);
    assert.ok(match, `the clip is ${clip}`);
    return match[1] ? match[1] / 100 : 1 - match[2] / 100;
}
/** Returns the pixel in the readout. */
async function pixel() {
    const words = await text("#readout"), match = /^x (\d+), y (\d+)/.exec(words);
    assert.ok(match, `no pixel in '${words}'`);
    return [+match[1], +match[2]];
}

// --- the checks -------------------------------------------------------------------------------------------------------

test("the first screen states what is wrong and what to do", async () => {
    await open("wrong");
    for (const [selector, want] of Object.entries({
        "#step": "Raysteps · step 03, mirror", "h1": "What does the mirror see?", "#checks-headline": "7 of 12 pass",
        "#picture-headline": "Different from the reference", "#next": "./learn hint 03 reflect",
        "#mistake-title": "The part along the normal is added instead of subtracted",
    }))
        assert.equal(await text(selector), want);
    assert.equal(await page.locator("#pair img").count(), 2, "pictures of the mistake");
    for (const selector of ["#checks-headline", "#picture-headline", "#mistake-facts", "#copy"]) {
        const { top, bottom } = await box(selector);
        assert.ok(top >= 0 && bottom <= desktop[1], `${selector} is not on the first screen: ${top} to ${bottom}`);
    }
});

test("a good report shows no mistake", async () => {
    await open("good");
    assert.equal(await text("#checks-headline"), "74 of 74 pass");
    assert.equal(await text("#picture-headline"), "Same up to noise");
    assert.equal(await visible("#mistake"), false, "a mistake is shown");
    assert.match(await text("#numbers"), /1 tile with \|z\| > 4/);
});

test("without a known mistake the report links to the first failing check", async () => {
    await open("unknown");
    assert.equal(await text("#mistake-title"), "No known mistake fits");
    await click("#mistake-facts a");
    assert.equal(await see("location.hash"), "#check-0", "the link to the first red check");
});

test("the copy button copies the command", async () => {
    await open("wrong");
    await click("#copy");
    await page.waitForTimeout(200);
    assert.equal(await text("#copy"), "Copied");
    assert.equal(await see("navigator.clipboard.readText()"), "./learn hint 03 reflect");
});

test("the slider follows a drag", async () => {
    await open("wrong");
    const point = await showPane();
    assert.deepEqual(await layers(), [["reference", "mine"]]);
    near(await wipe(), 0.5, 1e-3, "initial wipe");
    await drag(point(0.5, 0.4), point(0.25, 0.6));
    near(await wipe(), 0.25, 2e-3, "wipe after a drag of the handle to a quarter");
    assert.equal(await page.$eval("#handle", e => e.ariaValueNow), "25", "value for a screen reader");
    const handle = await box("#handle");
    near(handle.left + handle.width / 2, point(0.25, 0)[0], 1.5, "the handle's centre");
    await drag(point(0.25, 0.5), [point(1, 0)[0] + 40, point(0, 0.5)[1]]);
    near(await wipe(), 1, 1e-3, "wipe after a drag beyond the edge");
    await move(point(0.5, 0.5));
    near(await wipe(), 1, 1e-3, "wipe after the button was released");
});

test("the slider follows a finger and the page still scrolls", async () => {
    await open("wrong", phone);
    const point = await showPane();
    await touch("touchStart", point(0.5, 0.5));
    for (const share of [0.6, 0.7, 0.8]) await touch("touchMove", point(share, 0.5));
    await touch("touchEnd");
    near(await wipe(), 0.8, 6e-3, "wipe");
    assert.equal(await style("#stage", "touchAction"), "pan-y", "touch action if the picture is not zoomed");
});

test("swap shows the reference under the pointer", async () => {
    await open("wrong");
    await click("[data-mode=swap]");
    const point = await showPane();
    for (const [where, picture, name] of [[[2, 2], "mine", "yours"], [point(0.5, 0.5), "reference", "reference"],
        [[2, 2], "mine", "yours"]]) {
        await move(where);
        assert.deepEqual(await layers(), [[picture]]);
        assert.equal(await text(".tag.left"), name);
    }
});

test("swap shows the reference while Space or a finger is held", async () => {
    await open("wrong", phone);
    await click("[data-mode=swap]");
    const point = await showPane();
    assert.deepEqual(await layers(), [["mine"]], "before a touch");
    await touch("touchStart", point(0.5, 0.5));
    assert.deepEqual(await layers(), [["reference"]], "under a finger");
    await touch("touchEnd");
    assert.deepEqual(await layers(), [["mine"]], "after it");
    await page.focus("#stage");
    await page.keyboard.down(" ");
    assert.deepEqual(await layers(), [["reference"]], "with Space held");
    await page.keyboard.up(" ");
    assert.deepEqual(await layers(), [["mine"]], "with Space released");
});

test("side by side and map show their pictures", async () => {
    await open("wrong");
    await click("[data-mode=side]");
    assert.deepEqual(await layers(), [["mine"], ["reference"]]);
    const corners = () => all(".pane", panes => panes.map(pane => pane.getBoundingClientRect().toJSON()));
    const [left, right] = await corners();
    assert.ok(left.left < right.left, "the panes are not side by side");
    await click("[data-mode=map]");
    assert.deepEqual(await layers(), [["map"]]);
    assert.deepEqual(await all("#modes [aria-pressed=true]", buttons => buttons.map(b => b.dataset.mode)), ["map"]);
    await open("wrong", phone);
    await click("[data-mode=side]");
    const [upper, lower] = await corners();
    assert.ok(upper.top < lower.top, "on a phone the panes are not stacked");
});

test("the buttons zoom in to whole pixels", async () => {
    await open("wrong");
    const fit = await scale();
    assert.equal(await style(".layer img", "imageRendering"), "auto");
    assert.ok(await page.isDisabled("#zoom-out"), "zoom out must be disabled for the whole picture");
    for (const want of [2, 3, 4, 6, 8]) {
        await click("#zoom-in");
        near(await scale(), want, 1e-3, "scale after a click on +");
    }
    assert.equal(await style(".layer img", "imageRendering"), "pixelated");
    assert.equal(await text("#zoom-value"), "800 %");
    await click("#zoom-out");
    near(await scale(), 6, 1e-3, "scale after a click on -");
    await click("#zoom-fit");
    near(await scale(), fit, 1e-3, "scale after a click on Fit");
});

test("the wheel zooms around the pointer and a drag pans", async () => {
    await open("wrong");
    await click("[data-mode=map]");
    const begin = await pointOf(448, 120), fit = await scale();
    await move(begin);
    assert.deepEqual(await pixel(), [448, 120], "pixel before the zoom");
    await wheel(begin, -1000);
    near(await scale() / fit, 7.389, 0.01, "zoom factor of a wheel delta of 1000: e squared");
    await move([begin[0] + 1, begin[1]]);
    await move(begin);
    assert.deepEqual(await pixel(), [448, 120], "pixel under the pointer after the zoom");
    const step = await scale() * 10;
    await drag(begin, [begin[0] - step, begin[1] + step]);
    assert.deepEqual(await pixel(), [448, 120], "a dragged pixel must follow the pointer");
    await move(begin);
    const [x, y] = await pixel();
    near(x, 458, 1, "x of the pixel now at this point");
    near(y, 110, 1, "y of the pixel now at this point");
    const scroll = await see("scrollY");
    await wheel(begin, 5000);
    near(await scale(), fit, 1e-3, "scale after the wheel was turned back");
    assert.equal(await see("scrollY"), scroll, "the page must not scroll");
});

test("zoom and position are kept from view to view", async () => {
    await open("wrong");
    const point = await showPane();
    await wheel(point(0.2, 0.8), -1200);
    const zoomed = await scale();
    assert.ok(zoomed > 8, `scale ${zoomed}`);
    await move(point(0.5, 0.5));
    const middle = await pixel();
    for (const key of ["2", "4", "1"]) {
        await press(key);
        near(await scale(), zoomed, 1e-3, `scale in view ${key}`);
        await move(point(0.5, 0.45));
        await move(point(0.5, 0.5));
        assert.deepEqual(await pixel(), middle, `pixel at the centre of view ${key}`);
    }
    await press("3");
    const transforms = await all(".layer:not([hidden]) img", images => images.map(i => i.style.transform));
    assert.equal(transforms.length, 2, "pictures side by side");
    assert.equal(transforms[0], transforms[1], "both must show the same place");
});

test("two fingers pinch", async () => {
    await open("wrong", phone);
    await click("[data-mode=map]");
    const point = await showPane(), fit = await scale();
    await touch("touchStart", point(0.4, 0.5));
    await touch("touchStart", point(0.4, 0.5), point(0.6, 0.5));
    for (const share of [0.35, 0.3, 0.25, 0.2]) await touch("touchMove", point(share, 0.5), point(1 - share, 0.5));
    await touch("touchEnd");
    near(await scale() / fit, 3, 0.15, "zoom when two fingers move to three times their distance");
    assert.equal(await style("#stage", "touchAction"), "none", "touch action if the picture is zoomed");
});

test("the readout shows pixel and colours", async () => {
    await open("wrong");
    for (const [x, y, same] of [[160, 300, true], [480, 100, false]]) {
        await move(await pointOf(x, y));
        assert.deepEqual(await pixel(), [x, y]);
        const words = await text("#readout");
        const [, yours, reference] = /yours (\d+ \d+ \d+)\s+reference (\d+ \d+ \d+)/.exec(words) ?? assert.fail(words);
        assert.equal(yours === reference, same, `the colours at ${x},${y}: ${words}`);
    }
});

test("the keys have the same functions as the pointer", async () => {
    await open("wrong");
    for (const [key, mode] of [["4", "map"], ["3", "side"], ["2", "swap"], ["1", "slider"]]) {
        await press(key);
        assert.equal(await page.getAttribute("#stage", "data-mode"), mode, `view after the key ${key}`);
    }
    await press("ArrowLeft", "ArrowLeft", "ArrowLeft");
    near(await wipe(), 0.44, 1e-3, "wipe after three arrows to the left");
    await page.focus("#handle");
    for (const [keys, want] of [[["ArrowRight", "ArrowUp"], 0.48], [["Home"], 0], [["End"], 1]]) {
        await press(...keys);
        near(await wipe(), want, 1e-3, `wipe after ${keys}`);
    }
    await press("+", "+");
    near(await scale(), 3, 1e-3, "scale after + twice");
    const before = (await box(".layer img")).left;
    await press("Shift+ArrowRight");
    const moved = (await box(".layer img")).left - before;
    assert.ok(moved < -20, `Shift and an arrow key do not move the picture: ${moved}`);
    await press("-");
    near(await scale(), 2, 1e-3, "scale after -");
    await press("0");
    assert.ok(await scale() < 2, "0 does not fit the picture into the pane");
});

test("the focus reaches every control and is visible", async () => {
    await open("wrong");
    const names = [];
    for (let i = 0; i < 40; ++i) {
        await press("Tab");
        const [name, seen] = await see(`(() => {
            const e = document.activeElement, s = getComputedStyle(e), after = getComputedStyle(e, '::after');
            return [e.id || e.dataset.mode || e.tagName,
                    s.outlineStyle !== 'none' || after.boxShadow.includes('5px')] })()`);
        if (name === "BODY" || name === names[0]) break;
        names.push(name);
        assert.ok(seen, `the focus on ${name} is not visible`);
    }
    for (const name of ["copy", "slider", "swap", "side", "map", "zoom-in", "stage", "handle", "SUMMARY"])
        assert.ok(names.includes(name), `the tab key does not reach ${name}: ${names}`);
});

test("failing checks are first and expanded", async () => {
    await open("wrong");
    assert.deepEqual(await all("#checks .check", checks => checks.map(c => c.dataset.state)),
        [...Array(3).fill("failed"), "unfinished", "skipped", ...Array(7).fill("ok")]);
    assert.ok(await all("#checks > details.check", checks => checks.every(d => d.open)), "a failing check is not expanded");
    assert.match(await text("#checks"), /expected 0\.6 within 1e-05, got -0\.6/);
    assert.equal(await visible("#green .check"), false, "the passing checks are visible");
    await click("#green summary");
    assert.equal(await visible("#green .check"), true, "the passing checks are not visible after a click");
    assert.equal(await page.locator("#dots .mark[data-state=ok]").count(), 7, "marks of passing checks");
});

test("without pictures the report states why", async () => {
    await open("unbuilt");
    assert.equal(await visible("#viewer"), false, "a viewer is shown");
    assert.equal(await text("#checks-headline"), "No check has run");
    assert.match(await text("#missing"), /The program did not build[^]*mirror\.h:24:12: error/);
    await open("single");
    assert.deepEqual(await layers(), [["reference"]], "the only picture");
    assert.equal(await visible("#modes"), false, "views of two pictures are available");
    assert.match(await text("#missing"), /stopped after 10 s/);
    await press("2", "4");
    assert.deepEqual(await layers(), [["reference"]], "the only picture after the keys of other views");
});

test("foreign text is never executed", async () => {
    await open("evil");
    assert.ok(await see("window.harm === undefined"), "a text was executed");
    const evil = "</script><script>window.harm = 1</script><!-- <img src=x onerror=\"window.harm = 1\"> ' & \\ {{data}} " +
        "a_long_word".repeat(12);
    for (const selector of ["h1", "#files", "#earlier", "#picture-lines", "#mistake-title", "#confidence",
        "#mistake-facts dd", "#next", "#settings", ".check .name", ".check .lines"]) {
        const shown = await text(selector);
        assert.ok(shown.includes(evil), `${selector} does not show the text unchanged: ${shown}`);
    }
});

test("pictures have an alternative text and buttons have a name", async () => {
    for (const name of pages) {
        await open(name);
        assert.equal(await page.locator("img:not([alt]), img[alt='']").count(), 0, `${name}: pictures without an alternative text`);
        const signs = await all("button", buttons => buttons.map(b => b.ariaLabel || b.textContent)
            .filter(label => !/[A-Za-z]/.test(label)));
        assert.deepEqual(signs, [], `${name}: buttons whose name is not a word`);
        assert.equal(await page.locator("h1").count(), 1, `${name}: first-level headings`);
    }
});

const openDetails = () => all("details", details => details.forEach(d => { d.open = true; }));

test("nothing scrolls sideways", async () => {
    for (const name of pages)
        for (const size of [phone, tablet, desktop]) {
            await open(name, size);
            await openDetails();
            for (const key of ["1", "3"]) {
                await press(key);
                const wide = await all("body *", elements => elements.filter(e => e.checkVisibility() &&
                    !e.closest(".pane, .unseen") && e.getBoundingClientRect().right > innerWidth + .5)
                    .map(e => `${e.tagName}#${e.id}.${e.className}`));
                assert.deepEqual(wide, [], `${name} at ${size[0]}, view ${key}: wider than the window`);
                const [width, room] = await see("[document.documentElement.scrollWidth, innerWidth]");
                assert.equal(room, size[0], `${name}: width of the window`);
                assert.ok(width <= room, `${name} at ${room}: the page is ${width} wide`);
            }
        }
});

/** Returns the contrast of each text with its background (WCAG 2.1). */
const contrasts = elements => {
    const channels = colour => colour.match(/[\d.]+/g).map(Number);
    const linear = v => v / 255 <= .04045 ? v / 255 / 12.92 : ((v / 255 + .055) / 1.055) ** 2.4;
    const luminance = ([r, g, b]) => .2126 * linear(r) + .7152 * linear(g) + .0722 * linear(b);
    const ground = e => {
        if (!e) return [255, 255, 255];
        const c = channels(getComputedStyle(e).backgroundColor);
        return c.length < 4 || c[3] === 1 ? c : ground(e.parentElement);
    };
    const has_text = e => [...e.childNodes].some(n => n.nodeType === 3 && n.data.trim());
    return elements.filter(e => e.checkVisibility() && !e.closest(".pane, :disabled, .unseen") && has_text(e)).map(e => {
        const a = luminance(channels(getComputedStyle(e).color)), b = luminance(ground(e));
        return [`${e.tagName}#${e.id}.${e.className}`, (Math.max(a, b) + .05) / (Math.min(a, b) + .05)];
    });
};

test("both colour schemes are legible", async () => {
    for (const colorScheme of ["light", "dark"])
        for (const name of ["wrong", "good", "unbuilt"]) {
            await open(name, desktop, { colorScheme, reducedMotion: "reduce" }); // no colour transition is in progress
            await openDetails();
            const [red, green, blue] = (await style("body", "backgroundColor")).match(/\d+/g).map(Number);
            assert.equal((red + green + blue) / 3 > 128, colorScheme === "light", `the background in the ${colorScheme} scheme`);
            const found = await all("body *", contrasts);
            assert.ok(found.length > 10, "too few texts");
            for (const [element, contrast] of found)
                assert.ok(contrast >= 4.5, `${name}, ${colorScheme}: ${element} has a contrast of ${contrast}, expected at least 4.5`);
        }
});

test("nothing moves if the reader prefers reduced motion", async () => {
    await open("wrong", desktop, { reducedMotion: "reduce" });
    assert.equal(await style("#copy", "transitionDuration"), "0s");
    assert.equal(await style("html", "scrollBehavior"), "auto");
    await open("wrong", desktop, { reducedMotion: "no-preference" });
    assert.notEqual(await style("#copy", "transitionDuration"), "0s", "the setting has no effect");
});

test("no page uses the network or logs a message", async () => { // last: examines the log of all pages
    for (const name of pages) await open(name);
    assert.ok(requests.length >= pages.length, `only ${requests.length} requests`);
    assert.deepEqual(requests.filter(url => !/^(file|data):/.test(url)), []);
    assert.deepEqual([...complaints], [], "console messages");
});

test("screenshots for developers of the page", { skip: !process.env.SCREENSHOTS }, async () => {
    for (const name of pages)
        for (const size of [phone, desktop])
            for (const colorScheme of ["light", "dark"]) {
                await open(name, size, { colorScheme });
                const file = path.join(process.env.SCREENSHOTS, `${name}_${size[0]}_${colorScheme}.png`);
                await page.screenshot({ path: file, fullPage: true });
            }
});
