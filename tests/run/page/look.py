"""Opens a page in Chromium without a window, waits for a text on it, prints what it says and takes a picture.

Usage: look.py URL WIDTHxHEIGHT PICTURE.png SECONDS TEXT [JAVASCRIPT]

Prints the page's text, then what JAVASCRIPT gives. Status 1 if TEXT does not come within SECONDS. Chromium is driven by its debugging pipe, which needs nothing but Python.
"""
import base64, fcntl, json, os, select, subprocess, sys, tempfile, time

OPTIONS = ["--headless=new", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
           "--remote-debugging-pipe", "--no-first-run", "--disable-background-networking"]
if os.geteuid() == 0:
    OPTIONS.append("--no-sandbox")


class Chromium:
    def __init__(self, home):
        to_read, self.to = os.pipe()
        self.answers, from_write = os.pipe()
        self.rest, self.calls, self.session = b"", 0, None

        def pipes_as_3_and_4():
            ends = [fcntl.fcntl(end, fcntl.F_DUPFD, 20) for end in (to_read, from_write)]
            for number, end in zip((3, 4), ends):
                os.dup2(end, number)

        self.process = subprocess.Popen(["chromium", "--user-data-dir=" + home, *OPTIONS, "about:blank"],
                                        preexec_fn=pipes_as_3_and_4, close_fds=False,
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        pages = [t for t in self.call("Target.getTargets")["targetInfos"] if t["type"] == "page"]
        self.session = self.call("Target.attachToTarget", targetId=pages[0]["targetId"], flatten=True)["sessionId"]

    def message(self):
        while b"\0" not in self.rest:
            if not select.select([self.answers], [], [], 500)[0]:
                raise RuntimeError("chromium does not answer")
            self.rest += os.read(self.answers, 1 << 20)
        message, self.rest = self.rest.split(b"\0", 1)
        return json.loads(message)

    def call(self, method, **parameters):
        self.calls += 1
        request = {"id": self.calls, "method": method, "params": parameters}
        if self.session:
            request["sessionId"] = self.session
        os.write(self.to, json.dumps(request).encode() + b"\0")
        while True:
            message = self.message()
            if message.get("id") == self.calls:
                if "error" in message:
                    raise RuntimeError(message["error"])
                return message["result"]

    def evaluate(self, script):
        result = self.call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)["result"]
        return result.get("value")


def look(chromium, url, size, picture, seconds, text, script):
    width, height = map(int, size.split("x"))
    chromium.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
    chromium.call("Page.navigate", url=url)
    end, said = time.time() + seconds, ""
    while text not in said and time.time() < end:
        time.sleep(0.05)
        said = chromium.evaluate("document.body ? document.body.innerText : ''") or ""
    print(said)
    if script:
        print(chromium.evaluate(script))
    with open(picture, "wb") as file:
        file.write(base64.b64decode(chromium.call("Page.captureScreenshot", format="png")["data"]))
    return text in said


def main(url, size, picture, seconds, text, script=""):
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as home:
        chromium = Chromium(home)
        try:
            return 0 if look(chromium, url, size, picture, float(seconds), text, script) else 1
        finally:
            chromium.process.terminate()
            chromium.process.wait()


sys.exit(main(*sys.argv[1:]))
