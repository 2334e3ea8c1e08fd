# The report in headless Chromium, driven by chromedriver: WebDriver is JSON over HTTP, so Python's own library will do.
# report.py FOLDER [--screenshots OUT]: FOLDER holds the reports that test_tutor writes. Exit 0 if all of it holds.
import base64
import json
import os
import pathlib
import re
import socket
import subprocess
import sys
import time
import traceback
import urllib.error
import urllib.request

ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # WebDriver's name for a reference to an element
KEYS = {"left": "\ue012", "up": "\ue013", "right": "\ue014", "down": "\ue015", "tab": "\ue004", "shift": "\ue008",
        "home": "\ue011", "end": "\ue010"}
DESKTOP, PHONE, TABLET = (1440, 900), (375, 812), (768, 1024)
PAGES = ("wrong", "good", "unbuilt", "evil", "single", "unknown")


class Browser:
    """A chromedriver process and one session in it."""

    def __init__(self, folder):
        self.folder = folder
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.base = f"http://127.0.0.1:{port}"
        self.http = urllib.request.build_opener(urllib.request.ProxyHandler({}))
        self.driver = subprocess.Popen(["chromedriver", f"--port={port}"], stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
        try:
            self.wait_for_driver()
            self.start_session()
        except BaseException:
            self.driver.kill()
            raise

    def wait_for_driver(self):
        for _ in range(200):
            try:
                if self.send("GET", "/status")["ready"]:
                    return
            except (urllib.error.URLError, ConnectionError):
                time.sleep(0.1)
        raise RuntimeError("chromedriver does not answer")

    def start_session(self):
        arguments = ["--headless=new", "--hide-scrollbars", "--force-device-scale-factor=1", "--disable-gpu",
                     "--disable-dev-shm-usage", "--window-size=1440,900"]
        if os.geteuid() == 0:
            arguments.append("--no-sandbox")
        wanted = {"browserName": "chrome", "goog:chromeOptions": {"args": arguments},
                  "goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"}}
        answer = self.send("POST", "/session", {"capabilities": {"alwaysMatch": wanted}})
        self.base += "/session/" + answer["sessionId"]

    def send(self, method, path, body=None):
        data = None if method == "GET" else json.dumps(body or {}).encode()
        request = urllib.request.Request(self.base + path, data, {"Content-Type": "application/json"}, method=method)
        try:
            with self.http.open(request, timeout=60) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            value = json.load(error)["value"]
            raise RuntimeError(f"{method} {path}: {value['error']}: {value['message'].splitlines()[0]}") from None

    def close(self):
        try:
            self.send("DELETE", "")
        finally:
            self.driver.terminate()
            self.driver.wait(10)

    def cdp(self, command, **parameters):
        return self.send("POST", "/goog/cdp/execute", {"cmd": command, "params": parameters})

    def run(self, script, *arguments):
        return self.send("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def open(self, name, size=DESKTOP, **media):
        """Opens a report anew at a size, with media features such as prefers_color_scheme="dark"."""
        features = [{"name": key.replace("_", "-"), "value": value} for key, value in media.items()]
        self.act({"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"},
                  "actions": [self.at((0, 0))]})
        self.cdp("Emulation.setEmulatedMedia", features=features)
        self.cdp("Emulation.setDeviceMetricsOverride", width=size[0], height=size[1],
                 deviceScaleFactor=2 if size == PHONE else 1, mobile=size == PHONE)
        self.cdp("Emulation.setTouchEmulationEnabled", enabled=size == PHONE)
        self.send("POST", "/url", {"url": (self.folder / (name + ".html")).as_uri()})
        self.run("return Promise.all([...document.images].map(image => image.decode()))")

    # --- what a person does ---------------------------------------------------------------------------------------

    def act(self, *sources):
        self.send("POST", "/actions", {"actions": list(sources)})

    @staticmethod
    def at(point, milliseconds=0):
        return {"type": "pointerMove", "x": round(point[0]), "y": round(point[1]), "duration": milliseconds}

    def mouse(self, *actions):
        self.act({"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": list(actions)})

    def point_of(self, x, y):
        """The point of the window where the middle of a pixel is, as long as the picture fits into its pane."""
        width, height = self.run("return [pictures.width, pictures.height]")
        return self.show_pane()((x + 0.5) / width, (y + 0.5) / height)

    def move(self, point):
        self.mouse(self.at(point))

    def drag(self, begin, end):
        self.mouse(self.at(begin), {"type": "pointerDown", "button": 0}, self.at(end, 100),
                   {"type": "pointerUp", "button": 0})

    def click(self, selector):
        self.run("document.querySelector(arguments[0]).scrollIntoView({block: 'center', behavior: 'instant'})",
                 selector)
        element = self.send("POST", "/element", {"using": "css selector", "value": selector})
        self.send("POST", f"/element/{element[ELEMENT]}/click")

    def press(self, *keys, holding=None):
        actions = [{"type": kind, "value": KEYS.get(key, key)} for key in keys for kind in ("keyDown", "keyUp")]
        if holding:
            key = KEYS.get(holding, holding)
            actions = [{"type": "keyDown", "value": key}, *actions, {"type": "keyUp", "value": key}]
        self.act({"type": "key", "id": "keyboard", "actions": actions})

    def key(self, kind, key):
        self.act({"type": "key", "id": "keyboard", "actions": [{"type": kind, "value": key}]})

    def wheel(self, point, delta):
        time.sleep(0.4)  # longer than the pause after which a wheel counts as turned over the picture
        turn = {"type": "scroll", "x": round(point[0]), "y": round(point[1]), "deltaX": 0, "deltaY": delta,
                "duration": 0}
        self.act({"type": "wheel", "id": "wheel", "actions": [turn]})
        time.sleep(0.1)

    def touch(self, kind, *fingers):
        """kind: touchStart, touchMove or touchEnd; a point of the window for each finger that is down then."""
        self.cdp("Input.dispatchTouchEvent", type=kind,
                 touchPoints=[{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(fingers)])

    # --- what a person sees ---------------------------------------------------------------------------------------

    def text(self, selector):
        return self.run("const e = document.querySelector(arguments[0]); return e ? e.innerText : null", selector)

    def visible(self, selector):
        return self.run("const e = document.querySelector(arguments[0]); return Boolean(e && e.checkVisibility())",
                        selector)

    def style(self, selector, name):
        return self.run("return getComputedStyle(document.querySelector(arguments[0]))[arguments[1]]", selector, name)

    def box(self, selector):
        """Left, top, width and height in the window."""
        return self.run("const b = document.querySelector(arguments[0]).getBoundingClientRect();"
                        "return [b.left, b.top, b.width, b.height]", selector)

    def show_pane(self):
        """Scrolls to the pictures; answers a function from shares of the first pane to a point of the window."""
        self.run("document.getElementById('viewer').scrollIntoView({block: 'start', behavior: 'instant'})")
        left, top, width, height = self.box(".pane")
        return lambda x, y: (left + x * width, top + y * height)

    def layers(self):
        """The pictures that are shown, pane by pane."""
        return self.run("return [...document.querySelectorAll('.pane')].filter(p => p.checkVisibility()).map("
                        "p => [...p.querySelectorAll('.layer')].filter(l => l.checkVisibility()).map("
                        "l => l.dataset.picture))")

    def scale(self):
        """How many CSS pixels a pixel of the picture takes: what the browser has laid out."""
        return self.run("return document.querySelector('.layer:not([hidden]) img').getBoundingClientRect().width /"
                        "document.querySelector('.layer:not([hidden]) img').width")

    def wipe(self):
        """The share of the pane, from its left, in which the learner's picture is seen."""
        clip = self.style(".layer[data-picture=mine]", "clipPath")
        match = re.fullmatch(r"inset\(0px (?:calc\(100% - ([\d.]+)%\)|([\d.]+)(?:%|px)) 0px 0px\)", clip)
        assert match, f"the clip is {clip}"
        return float(match[1]) / 100 if match[1] else 1 - float(match[2]) / 100

    def pixel(self):
        """The pixel that is read out."""
        match = re.match(r"x (\d+), y (\d+)", self.text("#readout"))
        assert match, f"no pixel in '{self.text('#readout')}'"
        return int(match[1]), int(match[2])


def expect(got, want, what):
    assert got == want, f"{what}: expected {want!r}, got {got!r}"


def near(got, want, tolerance, what):
    assert abs(got - want) <= tolerance, f"{what}: expected {want} within {tolerance}, got {got}"


# --- the checks -------------------------------------------------------------------------------------------------------

def first_screen_says_what_is_wrong_and_what_to_do(browser):
    browser.open("wrong")
    expect(browser.text("#step"), "Raysteps · step 03, mirror", "step")
    expect(browser.text("h1"), "What does the mirror see?", "question")
    expect(browser.text("#checks-headline"), "7 of 12 green", "headline of the checks")
    expect(browser.text("#picture-headline"), "A different picture", "headline of the picture")
    expect(browser.text("#mistake-title"), "The part along the normal is added in place of taken away", "mistake")
    expect(browser.text("#next"), "./learn hint 03 reflect", "next step")
    expect(browser.run("return document.querySelectorAll('#pair img').length"), 2, "pictures of the mistake")
    for selector in ("#checks-headline", "#picture-headline", "#mistake-facts", "#copy"):
        _, top, _, height = browser.box(selector)
        bottom = top + height
        assert top >= 0 and bottom <= DESKTOP[1], f"{selector} is not on the first screen: {top} to {bottom}"


def good_report_is_calm(browser):
    browser.open("good")
    expect(browser.text("#checks-headline"), "74 of 74 green", "headline of the checks")
    expect(browser.text("#picture-headline"), "The same up to noise", "headline of the picture")
    expect(browser.visible("#mistake"), False, "a mistake is shown")
    assert "1 tile beyond |z| = 4" in browser.text("#numbers"), browser.text("#numbers")


def without_a_known_mistake_it_says_where_to_begin(browser):
    browser.open("unknown")
    expect(browser.text("#mistake-title"), "None that we know", "mistake")
    browser.click("#mistake-facts a")
    expect(browser.run("return location.hash"), "#check-0", "the link to the first red check")


def copy_button_copies_the_command(browser):
    browser.open("wrong")
    browser.cdp("Browser.grantPermissions", permissions=["clipboardReadWrite", "clipboardSanitizedWrite"])
    browser.click("#copy")
    time.sleep(0.2)
    expect(browser.text("#copy"), "Copied", "the button's word")
    expect(browser.run("return navigator.clipboard.readText()"), "./learn hint 03 reflect", "clipboard")


def slider_follows_a_drag(browser):
    browser.open("wrong")
    point = browser.show_pane()
    expect(browser.layers(), [["reference", "mine"]], "pictures of the slider")
    near(browser.wipe(), 0.5, 1e-3, "wipe at first")
    browser.drag(point(0.5, 0.4), point(0.25, 0.6))
    near(browser.wipe(), 0.25, 2e-3, "wipe after a drag of the handle to a quarter")
    expect(browser.run("return document.getElementById('handle').ariaValueNow"), "25", "value for a screen reader")
    handle = browser.box("#handle")
    near(handle[0] + handle[2] / 2, point(0.25, 0)[0], 1.5, "the handle's middle")
    browser.drag(point(0.25, 0.5), (point(1, 0)[0] + 40, point(0, 0.5)[1]))
    near(browser.wipe(), 1, 1e-3, "wipe after a drag beyond the edge")
    browser.move(point(0.5, 0.5))
    near(browser.wipe(), 1, 1e-3, "wipe after the button was let go")


def slider_follows_a_finger_and_the_page_scrolls_on(browser):
    browser.open("wrong", PHONE)
    point = browser.show_pane()
    browser.touch("touchStart", point(0.5, 0.5))
    for share in (0.6, 0.7, 0.8):
        browser.touch("touchMove", point(share, 0.5))
    browser.touch("touchEnd")
    near(browser.wipe(), 0.8, 6e-3, "wipe")
    expect(browser.style("#stage", "touchAction"), "pan-y", "what a finger may do where nothing is zoomed")


def swap_shows_the_reference_under_the_pointer(browser):
    browser.open("wrong")
    browser.click("[data-mode=swap]")
    point = browser.show_pane()
    browser.move((2, 2))
    expect(browser.layers(), [["mine"]], "away from the picture")
    browser.move(point(0.5, 0.5))
    expect(browser.layers(), [["reference"]], "on the picture")
    expect(browser.text(".tag.left"), "reference", "its name")
    browser.move((2, 2))
    expect(browser.layers(), [["mine"]], "away again")
    expect(browser.text(".tag.left"), "yours", "its name")


def swap_shows_the_reference_while_space_or_a_finger_holds(browser):
    browser.open("wrong", PHONE)
    browser.click("[data-mode=swap]")
    point = browser.show_pane()
    expect(browser.layers(), [["mine"]], "before a touch")
    browser.touch("touchStart", point(0.5, 0.5))
    expect(browser.layers(), [["reference"]], "under a finger")
    browser.touch("touchEnd")
    expect(browser.layers(), [["mine"]], "after it")
    browser.run("document.getElementById('stage').focus()")
    browser.key("keyDown", " ")
    expect(browser.layers(), [["reference"]], "with Space held")
    browser.key("keyUp", " ")
    expect(browser.layers(), [["mine"]], "with Space let go")


def side_by_side_and_map_show_their_pictures(browser):
    browser.open("wrong")
    browser.click("[data-mode=side]")
    expect(browser.layers(), [["mine"], ["reference"]], "side by side")
    left, right = browser.run("return [...document.querySelectorAll('.pane')].map(p => p.getBoundingClientRect().left)")
    assert left < right, "the panes do not stand beside each other"
    browser.click("[data-mode=map]")
    expect(browser.layers(), [["map"]], "error map")
    expect(browser.run("return [...document.querySelectorAll('#modes [aria-pressed=true]')].map(b => b.dataset.mode)"),
           ["map"], "the pressed buttons")
    browser.open("wrong", PHONE)
    browser.click("[data-mode=side]")
    upper, lower = browser.run("return [...document.querySelectorAll('.pane')].map(p => p.getBoundingClientRect().top)")
    assert upper < lower, "on a phone the panes do not stand under each other"


def buttons_zoom_to_pixels(browser):
    browser.open("wrong")
    fit = browser.scale()
    expect(browser.style(".layer img", "imageRendering"), "auto", "rendering of the whole picture")
    expect(browser.run("return document.getElementById('zoom-out').disabled"), True, "no way to zoom out of the whole")
    for want in (2, 3, 4, 6, 8):
        browser.click("#zoom-in")
        near(browser.scale(), want, 1e-3, "scale after a click on +")
    expect(browser.style(".layer img", "imageRendering"), "pixelated", "rendering of pixels")
    expect(browser.text("#zoom-value"), "800 %", "zoom in words")
    browser.click("#zoom-out")
    near(browser.scale(), 6, 1e-3, "scale after a click on -")
    browser.click("#zoom-fit")
    near(browser.scale(), fit, 1e-3, "scale after a click on Fit")


def wheel_zooms_around_the_pointer_and_a_drag_pans(browser):
    browser.open("wrong")
    browser.click("[data-mode=map]")
    begin = browser.point_of(448, 120)
    browser.move(begin)
    expect(browser.pixel(), (448, 120), "pixel at 7 tenths of the width and 3 of the height")
    fit = browser.scale()
    browser.wheel(begin, -1000)
    near(browser.scale() / fit, 7.389, 0.01, "a wheel turned by 1000 zooms by e squared")
    browser.move((begin[0] + 1, begin[1]))
    browser.move(begin)
    expect(browser.pixel(), (448, 120), "pixel under the pointer after the zoom")
    step = browser.scale() * 10
    browser.drag(begin, (begin[0] - step, begin[1] + step))
    expect(browser.pixel(), (448, 120), "the pixel goes with the pointer that drags it")
    browser.move(begin)
    near(browser.pixel()[0], 458, 1, "x of what lies there now")
    near(browser.pixel()[1], 110, 1, "y of what lies there now")
    scroll = browser.run("return scrollY")
    browser.wheel(begin, 5000)
    near(browser.scale(), fit, 1e-3, "scale after the wheel was turned back")
    expect(browser.run("return scrollY"), scroll, "the page did not scroll meanwhile")


def zoom_and_place_stay_from_view_to_view(browser):
    browser.open("wrong")
    point = browser.show_pane()
    browser.wheel(point(0.2, 0.8), -1200)
    scale = browser.scale()
    assert scale > 8, f"scale {scale}"
    browser.move(point(0.5, 0.5))
    middle = browser.pixel()
    for mode in ("swap", "map", "slider"):
        browser.press({"swap": "2", "map": "4", "slider": "1"}[mode])
        near(browser.scale(), scale, 1e-3, f"scale in the view {mode}")
        browser.move(point(0.5, 0.45))
        browser.move(point(0.5, 0.5))
        expect(browser.pixel(), middle, f"pixel in the middle of the view {mode}")
    browser.press("3")
    transforms = browser.run("return [...document.querySelectorAll('.layer:not([hidden]) img')]"
                             ".map(i => i.style.transform)")
    expect(len(transforms), 2, "pictures side by side")
    expect(transforms[0], transforms[1], "they show the same place")


def two_fingers_pinch(browser):
    browser.open("wrong", PHONE)
    browser.click("[data-mode=map]")
    point = browser.show_pane()
    fit = browser.scale()
    browser.touch("touchStart", point(0.4, 0.5))
    browser.touch("touchStart", point(0.4, 0.5), point(0.6, 0.5))
    for share in (0.35, 0.3, 0.25, 0.2):
        browser.touch("touchMove", point(share, 0.5), point(1 - share, 0.5))
    browser.touch("touchEnd")
    near(browser.scale() / fit, 3, 0.15, "zoom when two fingers move to three times their distance")
    expect(browser.style("#stage", "touchAction"), "none", "what the page does with fingers where it is zoomed")


def readout_tells_pixel_and_colours(browser):
    browser.open("wrong")
    browser.move(browser.point_of(160, 300))
    expect(browser.pixel(), (160, 300), "pixel")
    words = browser.text("#readout")
    assert re.search(r"yours \d+ \d+ \d+\s+reference \d+ \d+ \d+", words), words
    yours, reference = re.findall(r"\d+ \d+ \d+", words)
    expect(yours, reference, "colours where the pictures agree")
    browser.move(browser.point_of(480, 100))
    expect(browser.pixel(), (480, 100), "pixel")
    yours, reference = re.findall(r"\d+ \d+ \d+", browser.text("#readout"))
    assert yours != reference, f"the same colour where the pictures differ: {yours}"


def keys_do_what_the_pointer_does(browser):
    browser.open("wrong")
    for key, mode in (("4", "map"), ("3", "side"), ("2", "swap"), ("1", "slider")):
        browser.press(key)
        expect(browser.run("return document.getElementById('stage').dataset.mode"), mode, f"view after the key {key}")
    browser.press("left", "left", "left")
    near(browser.wipe(), 0.44, 1e-3, "wipe after three arrows to the left")
    browser.run("document.getElementById('handle').focus()")
    browser.press("right", "up")
    near(browser.wipe(), 0.48, 1e-3, "wipe after an arrow to the right and one up")
    browser.press("home")
    near(browser.wipe(), 0, 1e-3, "wipe after Home")
    browser.press("end")
    near(browser.wipe(), 1, 1e-3, "wipe after End")
    browser.press("+", "+")
    near(browser.scale(), 3, 1e-3, "scale after + twice")
    before = browser.run("return document.querySelector('.layer img').getBoundingClientRect().left")
    browser.press("right", holding="shift")
    after = browser.run("return document.querySelector('.layer img').getBoundingClientRect().left")
    assert after < before - 20, f"Shift and an arrow do not move the picture: {before} to {after}"
    browser.press("-")
    near(browser.scale(), 2, 1e-3, "scale after -")
    browser.press("0")
    assert browser.scale() < 2, "0 does not fit the picture in"


def focus_goes_through_everything_and_is_seen(browser):
    browser.open("wrong")
    names = []
    for _ in range(40):
        browser.press("tab")
        name, seen = browser.run("""
            const e = document.activeElement, s = getComputedStyle(e), after = getComputedStyle(e, '::after');
            return [e.id || e.dataset.mode || e.tagName,
                    s.outlineStyle !== 'none' || after.boxShadow.includes('5px')]""")
        if name == "BODY" or name in names[:1]:
            break
        names.append(name)
        assert seen, f"the focus on {name} is not seen"
    for name in ("copy", "slider", "swap", "side", "map", "zoom-in", "stage", "handle", "SUMMARY"):
        assert name in names, f"the tab key does not reach {name}: {names}"


def red_checks_stand_first_and_open(browser):
    browser.open("wrong")
    states = browser.run("return [...document.querySelectorAll('#checks .check')].map(c => c.dataset.state)")
    expect(states, ["failed"] * 3 + ["unfinished", "skipped"] + ["ok"] * 7, "states in their order")
    expect(browser.run("return [...document.querySelectorAll('#checks > details.check')].every(d => d.open)"), True,
           "all that are not green are open")
    assert "expected 0.6 within 1e-05, got -0.6" in browser.text("#checks"), "what was expected is not to be read"
    expect(browser.visible("#green .check"), False, "the green ones are seen")
    browser.click("#green summary")
    expect(browser.visible("#green .check"), True, "the green ones are seen after a click")
    expect(browser.run("return document.querySelectorAll('#dots .mark[data-state=ok]').length"), 7, "green marks")


def without_pictures_it_says_why(browser):
    browser.open("unbuilt")
    expect(browser.visible("#viewer"), False, "a viewer is shown")
    expect(browser.text("#checks-headline"), "No check has run", "headline of the checks")
    words = browser.text("#missing")
    assert "The program did not build" in words and "mirror.h:24:12: error" in words, words
    browser.open("single")
    expect(browser.layers(), [["reference"]], "the one picture that there is")
    expect(browser.visible("#modes"), False, "views of two pictures are offered")
    assert "stopped after 10 s" in browser.text("#missing"), browser.text("#missing")
    browser.press("2", "4")
    expect(browser.layers(), [["reference"]], "the one picture after the keys of other views")


def texts_are_only_texts(browser):
    browser.open("evil")
    expect(browser.run("return window.harm === undefined"), True, "no text has run as a program")
    text = "</script><script>window.harm = 1</script><!-- <img src=x onerror=\"window.harm = 1\"> ' & \\ {{report}} "
    text += "a_long_word" * 12
    for selector in ("h1", "#files", "#earlier", "#picture-lines", "#mistake-title", "#confidence", "#mistake-facts dd",
                     "#next", "#settings", ".check .name", ".check .lines"):
        assert text in browser.text(selector), f"{selector} does not show the text as it is: {browser.text(selector)}"


def pictures_have_a_text_and_buttons_a_name(browser):
    for page in PAGES:
        browser.open(page)
        silent = browser.run("return [...document.images].filter(i => !i.alt).length")
        expect(silent, 0, f"{page}: pictures without a text")
        signs = browser.run("return [...document.querySelectorAll('button')].map(b => b.ariaLabel || b.textContent)"
                            ".filter(name => !/[A-Za-z]/.test(name))")
        expect(signs, [], f"{page}: buttons whose name is no word")
        expect(browser.run("return document.querySelectorAll('h1').length"), 1, f"{page}: headings of the first order")


def nothing_scrolls_sideways(browser):
    for page in PAGES:
        for size in (PHONE, TABLET, DESKTOP):
            browser.open(page, size)
            browser.run("for (const d of document.querySelectorAll('details')) d.open = true")
            for mode in ("slider", "side"):
                browser.press({"slider": "1", "side": "3"}[mode])
                wide = browser.run("""
                    return [...document.body.querySelectorAll('*')].filter(e => e.checkVisibility()
                        && !e.closest('.pane, .unseen') && e.getBoundingClientRect().right > innerWidth + .5)
                        .map(e => e.tagName + '#' + e.id + '.' + e.className)""")
                expect(wide, [], f"{page} at {size[0]}, {mode}: what is wider than the window")
                width, room = browser.run("return [document.documentElement.scrollWidth, innerWidth]")
                expect(room, size[0], f"{page}: width of the window")
                assert width <= room, f"{page} at {room}: the page is {width} wide"


CONTRASTS = """
function channels(text) { return text.match(/[\\d.]+/g).map(Number); }
function light(rgb) {
    const [r, g, b] = rgb.map(v => v / 255).map(v => v <= .04045 ? v / 12.92 : ((v + .055) / 1.055) ** 2.4);
    return .2126 * r + .7152 * g + .0722 * b;
}
function ground(e) {
    for (; e; e = e.parentElement) {
        const c = channels(getComputedStyle(e).backgroundColor);
        if (c.length < 4 || c[3] === 1) return c.slice(0, 3);
    }
    return [255, 255, 255];
}
return [...document.body.querySelectorAll('*')].filter(e => e.checkVisibility()
    && !e.closest('.pane, :disabled, .unseen')
    && [...e.childNodes].some(n => n.nodeType === 3 && n.data.trim())).map(e => {
        const s = getComputedStyle(e), a = light(channels(s.color).slice(0, 3)), b = light(ground(e));
        return [e.tagName + '#' + e.id + '.' + e.className, (Math.max(a, b) + .05) / (Math.min(a, b) + .05)];
    });
"""


def both_colour_schemes_are_legible(browser):
    for scheme in ("light", "dark"):
        for page in ("wrong", "good", "unbuilt"):
            # Without motion, so that no colour is on its way to another.
            browser.open(page, prefers_color_scheme=scheme, prefers_reduced_motion="reduce")
            browser.run("for (const d of document.querySelectorAll('details')) d.open = true")
            red, green, blue = map(int, re.findall(r"\d+", browser.style("body", "backgroundColor"))[:3])
            expect((red + green + blue) / 3 > 128, scheme == "light", f"the paper is light in the {scheme} scheme")
            contrasts = browser.run(CONTRASTS)
            assert len(contrasts) > 10, "there are hardly any texts"
            for name, contrast in contrasts:
                assert contrast >= 4.5, f"{page}, {scheme}: {name} has a contrast of {contrast:.2f}, wanted 4.5"


def nothing_moves_for_who_does_not_like_it(browser):
    browser.open("wrong", prefers_reduced_motion="reduce")
    expect(browser.style("#copy", "transitionDuration"), "0s", "transition of a button")
    expect(browser.style("html", "scrollBehavior"), "auto", "scrolling")
    browser.open("wrong", prefers_reduced_motion="no-preference")
    assert browser.style("#copy", "transitionDuration") != "0s", "the wish changes nothing"


def no_page_asks_a_network_or_complains(browser):
    for page in PAGES:
        browser.open(page)
    requests = 0
    for entry in browser.send("POST", "/se/log", {"type": "performance"}):
        message = json.loads(entry["message"])["message"]
        if message["method"] == "Network.requestWillBeSent":
            requests += 1
            url = message["params"]["request"]["url"]
            assert url.startswith(("file:", "data:")), f"a request to {url[:200]}"
    assert requests >= len(PAGES), f"the log tells of {requests} requests only"
    complaints = sorted({entry["message"] for entry in browser.send("POST", "/se/log", {"type": "browser"})})
    expect(complaints, [], "what the console says")


CHECKS = (
    first_screen_says_what_is_wrong_and_what_to_do, good_report_is_calm, without_a_known_mistake_it_says_where_to_begin,
    copy_button_copies_the_command, slider_follows_a_drag, slider_follows_a_finger_and_the_page_scrolls_on,
    swap_shows_the_reference_under_the_pointer, swap_shows_the_reference_while_space_or_a_finger_holds,
    side_by_side_and_map_show_their_pictures, buttons_zoom_to_pixels, wheel_zooms_around_the_pointer_and_a_drag_pans,
    zoom_and_place_stay_from_view_to_view, two_fingers_pinch, readout_tells_pixel_and_colours,
    keys_do_what_the_pointer_does, focus_goes_through_everything_and_is_seen, red_checks_stand_first_and_open,
    without_pictures_it_says_why, texts_are_only_texts, pictures_have_a_text_and_buttons_a_name,
    nothing_scrolls_sideways, both_colour_schemes_are_legible, nothing_moves_for_who_does_not_like_it,
    no_page_asks_a_network_or_complains,  # last: it reads what all of them left in the logs
)


def take_screenshots(browser, out):
    """For the eyes of whoever changes the page."""
    out.mkdir(parents=True, exist_ok=True)
    for page in PAGES:
        for size in (PHONE, DESKTOP):
            for scheme in ("light", "dark"):
                browser.open(page, size, prefers_color_scheme=scheme)
                height = browser.run("return document.documentElement.scrollHeight")
                shot = browser.cdp("Page.captureScreenshot", captureBeyondViewport=True,
                                   clip={"x": 0, "y": 0, "width": size[0], "height": height, "scale": 1})
                (out / f"{page}_{size[0]}_{scheme}.png").write_bytes(base64.b64decode(shot["data"]))


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    browser = Browser(folder)
    bad = 0
    try:
        if len(sys.argv) == 4 and sys.argv[2] == "--screenshots":
            take_screenshots(browser, pathlib.Path(sys.argv[3]))
            return 0
        for check in CHECKS:
            begin = time.monotonic()
            name = check.__name__.replace("_", " ")
            try:
                check(browser)
                print(f"ok      {name} ({time.monotonic() - begin:.1f} s)", flush=True)
            except AssertionError as error:
                bad += 1
                print(f"FAILED  {name}: {error}", flush=True)
            except Exception:
                bad += 1
                print(f"FAILED  {name}:\n{traceback.format_exc()}", flush=True)
    finally:
        browser.close()
    print(f"{len(CHECKS) - bad} of {len(CHECKS)} checks of the report in Chromium")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
