// The search runs in a worker. Browsers start none from a file of the disk, so there its script runs in a hidden frame.
// Messages are copied into the world of their receiver, as those of a worker are, and arrive later than they are sent.
if (location.protocol === "file:") {
  window.Worker = class extends EventTarget {
    constructor(url) {
      super()
      this.onmessage = this.onerror = null
      this.frame = document.createElement("iframe")
      this.frame.hidden = true
      document.body.append(this.frame)
      const inside = this.frame.contentWindow
      inside.postMessage = data => setTimeout(() => {
        const event = new MessageEvent("message", { data: structuredClone(data) })
        this.dispatchEvent(event)
        if (this.onmessage) this.onmessage(event)
      })
      this.ready = new Promise((loaded, failed) => {
        const script = inside.document.createElement("script")
        script.src = new URL(url, document.baseURI)
        script.onload = loaded
        script.onerror = failed
        inside.document.body.append(script)
      })
      this.ready.catch(event => this.onerror && this.onerror(event))
    }
    postMessage(data) {
      const inside = this.frame.contentWindow
      this.ready.then(() => {
        const event = new inside.MessageEvent("message", { data: inside.structuredClone(data) })
        inside.dispatchEvent(event)
      }, () => {})
    }
    terminate() { this.frame.remove() }
  }
}
